// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/resample.h"

extern "C" {
#include <libavutil/channel_layout.h>
#include <libavutil/opt.h>
#include <libswresample/swresample.h>
}

#include <algorithm>
#include <cmath>
#include <memory>

#include "nodes/base/check.h"

namespace face::decode {

std::vector<float> resample(const std::vector<float>& samples, double from_hz, double to_hz) {
  if (from_hz == to_hz || samples.empty()) return samples;
  SwrContext* made = nullptr;
  AVChannelLayout mono = AV_CHANNEL_LAYOUT_MONO;
  int code = swr_alloc_set_opts2(&made, &mono, AV_SAMPLE_FMT_FLTP, static_cast<int>(to_hz), &mono, AV_SAMPLE_FMT_FLTP,
                                 static_cast<int>(from_hz), 0, nullptr);
  const auto release = [](SwrContext* context) { swr_free(&context); };
  const std::unique_ptr<SwrContext, decltype(release)> swr(made, release);
  if (code >= 0) {
    av_opt_set_int(swr.get(), "filter_size", 64, 0);  // taps per phase at the lower rate
    av_opt_set_double(swr.get(), "cutoff", 0.95, 0);  // of the lower Nyquist frequency
    av_opt_set_int(swr.get(), "exact_rational", 1, 0);
    av_opt_set_int(swr.get(), "phase_shift", 10, 0);
    code = swr_init(swr.get());
  }
  check(code >= 0, "cannot resample from ", from_hz, " Hz to ", to_hz, " Hz");
  const auto length = static_cast<std::size_t>(std::llround(static_cast<double>(samples.size()) * to_hz / from_hz));
  // Room for the filter's tail; what is beyond the length is cut.
  std::vector<float> out(length + 4096);
  std::size_t done = 0;
  constexpr std::size_t block = 1 << 16;  // swr counts in int
  for (std::size_t at = 0; at <= samples.size() && done < out.size(); at += block) {
    const std::size_t count = std::min(block, samples.size() - std::min(at, samples.size()));
    const auto* in = reinterpret_cast<const std::uint8_t*>(samples.data() + at);
    auto* to = reinterpret_cast<std::uint8_t*>(out.data() + done);
    const int room = static_cast<int>(std::min<std::size_t>(out.size() - done, 1 << 30));
    code = swr_convert(swr.get(), &to, room, count > 0 ? &in : nullptr, static_cast<int>(count));
    check(code >= 0, "cannot resample from ", from_hz, " Hz to ", to_hz, " Hz");
    done += static_cast<std::size_t>(code);
    if (count == 0) break;
  }
  for (std::uint8_t* to; done < length;) {  // the tail
    to = reinterpret_cast<std::uint8_t*>(out.data() + done);
    code = swr_convert(swr.get(), &to, static_cast<int>(out.size() - done), nullptr, 0);
    if (code <= 0) break;
    done += static_cast<std::size_t>(code);
  }
  std::fill(out.begin() + static_cast<std::ptrdiff_t>(std::min(done, length)), out.end(), 0.0f);
  out.resize(length);
  return out;
}

}  // namespace face::decode
