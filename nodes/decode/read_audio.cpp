// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_audio.h"

#include <sndfile.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswresample/swresample.h>
}

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>

#include "nodes/base/check.h"
#include "nodes/decode/av_input.h"
#include "nodes/decode/input_file.h"
#include "nodes/decode/resample.h"

namespace face::decode {
namespace {

// A recording as the file has it: samples interleaved.
struct Recording {
  std::vector<float> samples;
  std::size_t channels = 1;
  double rate_hz = 0;
  double start_s = 0;  // silence before it, where a video starts earlier than its sound
};

std::uint32_t little_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}

// libsndfile reads a WAV whose samples end early without a word. Sizes of 0 and 2^32 - 1 are those of recorders that
// write to a pipe and cannot go back: the samples then go to the end of the file.
void check_wav_is_whole(const FileStart& start, const std::string& title) {
  const std::string& bytes = start.bytes;
  if (bytes.size() < 12 || !bytes.starts_with("RIFF") || bytes.compare(8, 4, "WAVE") != 0) return;
  for (std::uint64_t at = 12; at + 8 <= bytes.size();) {
    const std::uint64_t size = little_endian(bytes, at + 4), left = start.size - at - 8;
    if (bytes.compare(at, 4, "data") == 0) {
      const bool open_ended = size == 0 || size >= 0x7FFFF000;
      if (!open_ended && size > left)
        fail(title, ": is truncated: found ", left, " bytes of samples from byte ", at + 8, ", its header promises ",
             size);
      return;
    }
    at += 8 + size + (size & 1);
  }
}

std::optional<Recording> read_with_sndfile(const std::string& path, const std::string& title) {
  SF_INFO info{};
  const std::unique_ptr<SNDFILE, int (*)(SNDFILE*)> in(sf_open(path.c_str(), SFM_READ, &info), &sf_close);
  if (!in) return std::nullopt;
  Recording recording;
  recording.channels = static_cast<std::size_t>(info.channels);
  recording.rate_hz = info.samplerate;
  const std::size_t block = 1 << 16;
  sf_count_t frames = 0;
  for (;;) {
    recording.samples.resize((static_cast<std::size_t>(frames) + block) * recording.channels);
    const sf_count_t got = sf_readf_float(
        in.get(), recording.samples.data() + static_cast<std::size_t>(frames) * recording.channels, block);
    frames += std::max<sf_count_t>(got, 0);
    if (got < static_cast<sf_count_t>(block)) break;
  }
  recording.samples.resize(static_cast<std::size_t>(frames) * recording.channels);
  if (sf_error(in.get()) != SF_ERR_NO_ERROR)
    fail(title, ": cannot be decoded after sample ", frames, ": ", sf_strerror(in.get()));
  // MP3 states an estimate only.
  const bool exact = (info.format & SF_FORMAT_TYPEMASK) != SF_FORMAT_MPEG && info.frames < INT64_MAX / 2;
  if (exact && frames < info.frames)
    fail(title, ": is truncated: found ", frames, " samples, its header promises ", info.frames);
  return recording;
}

Recording read_with_av(const std::string& path, const std::string& title) {
  AvInput input(path, title, AvInput::Kind::audio);
  Recording recording;
  recording.channels = static_cast<std::size_t>(input.codec().ch_layout.nb_channels);
  recording.rate_hz = input.codec().sample_rate;
  check(recording.channels > 0 && recording.rate_hz > 0, title, ": found ", recording.channels, " channels at ",
        recording.rate_hz, " Hz, expected sound");
  // Only the sample format changes here: to interleaved float.
  SwrContext* made = nullptr;
  const auto release = [](SwrContext* context) { swr_free(&context); };
  std::unique_ptr<SwrContext, decltype(release)> swr(nullptr, release);
  bool first = true;
  input.for_each_frame([&](const AVFrame& frame) {
    if (frame.sample_rate != static_cast<int>(recording.rate_hz) ||
        frame.ch_layout.nb_channels != static_cast<int>(recording.channels))
      fail(title, ": changes to ", frame.ch_layout.nb_channels, " channels at ", frame.sample_rate, " Hz after sample ",
           recording.samples.size() / recording.channels, ", expected one format throughout");
    if (first) {
      auto* layout = const_cast<AVChannelLayout*>(&frame.ch_layout);  // read only, though the library does not say so
      const int code = swr_alloc_set_opts2(&made, layout, AV_SAMPLE_FMT_FLT, frame.sample_rate, layout,
                                           static_cast<AVSampleFormat>(frame.format), frame.sample_rate, 0, nullptr);
      swr.reset(made);
      check(code >= 0 && swr_init(swr.get()) >= 0, title, ": its sample format cannot be converted");
      recording.start_s = std::max(0.0, input.time_s(frame));
      first = false;
    }
    const std::size_t at = recording.samples.size();
    recording.samples.resize(at + static_cast<std::size_t>(frame.nb_samples) * recording.channels);
    auto* to = reinterpret_cast<std::uint8_t*>(recording.samples.data() + at);
    const int got = swr_convert(swr.get(), &to, frame.nb_samples, const_cast<const std::uint8_t**>(frame.extended_data),
                                frame.nb_samples);
    check(got == frame.nb_samples, title, ": its sample format cannot be converted");
  });
  const double found_s = static_cast<double>(recording.samples.size() / recording.channels) / recording.rate_hz;
  const double stated_s = input.stated_duration_s();
  if (found_s < 0.9 * stated_s - 0.5)
    fail(title, ": is truncated: found ", found_s, " s of sound, its header promises ", stated_s, " s");
  return recording;
}

// The mean of the channels that have any signal.
std::vector<float> mix_down(const Recording& recording, const std::string& title) {
  const std::size_t channels = recording.channels, frames = recording.samples.size() / channels;
  std::vector<bool> sounds(channels, false);
  float peak = 0;
  for (std::size_t i = 0; i < recording.samples.size(); ++i) {
    const float x = recording.samples[i];
    if (!std::isfinite(x)) fail(title, ": found ", x, " at sample ", i / channels, ", expected finite samples");
    if (x != 0) sounds[i % channels] = true;
    peak = std::max(peak, std::abs(x));
  }
  const auto count = std::max<std::ptrdiff_t>(1, std::count(sounds.begin(), sounds.end(), true));
  const double scale = 1.0 / (static_cast<double>(count) * std::max(1.0f, peak));
  std::vector<float> mono(frames);
  for (std::size_t i = 0; i < frames; ++i) {
    double sum = 0;
    for (std::size_t c = 0; c < channels; ++c) sum += static_cast<double>(recording.samples[i * channels + c]);
    mono[i] = static_cast<float>(sum * scale);
  }
  return mono;
}

}  // namespace

ReadAudioResult read_audio(const engine::File& file, const ReadAudioOptions& options) {
  const std::string title = title_of(file);
  check_wav_is_whole(read_start(file, 1 << 20, "a recording"), title);
  std::optional<Recording> found = read_with_sndfile(file.path(), title);
  if (!found && !options.required && has_pictures_only(file.path())) {
    ReadAudioResult none;
    none.audio.rate_hz = std::round(options.rate_hz);
    none.silent = true;
    return none;
  }
  const Recording recording = found ? std::move(*found) : read_with_av(file.path(), title);
  check(!recording.samples.empty(), title, ": holds no samples, expected a recording");

  ReadAudioResult result;
  result.source_rate_hz = recording.rate_hz;
  result.source_channels = static_cast<double>(recording.channels);
  std::vector<float> mono = mix_down(recording, title);
  const auto lead = static_cast<std::size_t>(std::llround(recording.start_s * recording.rate_hz));
  mono.insert(mono.begin(), lead, 0.0f);
  result.audio.rate_hz = std::round(options.rate_hz);
  result.audio.samples = resample(mono, recording.rate_hz, result.audio.rate_hz);
  result.silent = true;
  for (float& x : result.audio.samples) {
    x = std::clamp(x, -1.0f, 1.0f);  // the filter may overshoot a little
    if (std::abs(x) > 1.0f / 32768) result.silent = false;
  }
  check(!result.audio.samples.empty(), title, ": lasts less than one sample at ", options.rate_hz, " Hz");
  return result;
}

}  // namespace face::decode
