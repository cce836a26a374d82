// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_wav.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "nodes/base/check.h"

namespace face::exports {

engine::File export_wav(const Audio& audio) {
  check(std::isfinite(audio.rate_hz) && audio.rate_hz >= 1 && audio.rate_hz < 1e9, "the recording has ", audio.rate_hz,
        " samples per second, expected 1 or more");
  const auto rate = static_cast<std::uint32_t>(std::lround(audio.rate_hz));
  const std::size_t data_bytes = audio.samples.size() * 2;
  check(data_bytes < 4'000'000'000u, "the recording has ", audio.samples.size(), " samples, too many for a WAV file");
  std::string out = "RIFF";
  const auto put = [&](std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
  };
  put(static_cast<std::uint32_t>(36 + data_bytes), 4);
  out += "WAVEfmt ";
  put(16, 4);        // bytes of the format
  put(1, 2);         // PCM
  put(1, 2);         // channels
  put(rate, 4);      // samples per second
  put(2 * rate, 4);  // bytes per second
  put(2, 2);         // bytes per sample
  put(16, 2);        // bits
  out += "data";
  put(static_cast<std::uint32_t>(data_bytes), 4);
  for (std::size_t i = 0; i < audio.samples.size(); ++i) {
    check(std::isfinite(audio.samples[i]), "sample ", i, " is ", audio.samples[i], ", expected a finite number");
    const long level =
        std::clamp(std::lround(32768.0 * std::clamp(double{audio.samples[i]}, -1.0, 1.0)), -32768L, 32767L);
    put(static_cast<std::uint32_t>(static_cast<std::int32_t>(level)), 2);
  }
  return engine::File::from_bytes(std::move(out), ".wav");
}

}  // namespace face::exports
