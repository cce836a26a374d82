// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_video.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/export/mp4_writer.h"
#include "nodes/export/timed_frames.h"

namespace face::exports {
namespace {

void check_picture(const Image& image, const Image& first, const std::string& id, const std::string& first_id) {
  check(image.channels == 1 || image.channels == 3 || image.channels == 4, "frame ", id, " has ", image.channels,
        " channels, expected 1, 3 or 4");
  const std::size_t expected = static_cast<std::size_t>(std::max(0, image.width)) *
                               static_cast<std::size_t>(std::max(0, image.height)) *
                               static_cast<std::size_t>(image.channels);
  check(expected > 0 && image.pixels.size() == expected, "frame ", id, " has ", image.pixels.size(),
        " bytes, expected ", expected, " for ", image.width, " x ", image.height, " x ", image.channels);
  check(image.width == first.width && image.height == first.height && image.channels == first.channels, "frame ", id,
        " is ", image.width, " x ", image.height, " x ", image.channels, ", but frame ", first_id, " is ", first.width,
        " x ", first.height, " x ", first.channels);
}

// The sound of [0, duration_s], neither more nor less.
std::vector<float> fitted(const Audio& audio, double duration_s) {
  std::vector<float> samples = audio.samples;
  samples.resize(static_cast<std::size_t>(std::llround(duration_s * audio.rate_hz)), 0.0f);
  for (float& sample : samples) sample = std::isfinite(sample) ? std::clamp(sample, -1.0f, 1.0f) : 0.0f;
  return samples;
}

}  // namespace

engine::File export_video(const engine::Seq<Image>& frames, const Timeline& timeline, const Audio* audio,
                          const ExportVideoOptions& options, engine::Progress& progress) {
  check_frames(frames.size(), timeline);
  const auto count = static_cast<double>(frames.size());
  Mp4Writer::Settings settings;
  settings.mean_rate_hz = count / (timeline.duration_s - timeline.time_s.front());
  settings.quality = options.quality;
  settings.audio_kbit_per_s = options.audio_kbit_per_s;
  const std::string folder = progress.scratch_folder();
  if (!folder.empty()) settings.path = folder + "/video.mp4";
  std::vector<float> sound;
  if (audio != nullptr && !audio->samples.empty()) {
    check(std::isfinite(audio->rate_hz) && audio->rate_hz > 0 && audio->rate_hz == std::floor(audio->rate_hz),
          "the sound has ", audio->rate_hz, " samples per second, expected a whole number above 0");
    settings.audio_rate_hz = static_cast<int>(audio->rate_hz);
    sound = fitted(*audio, timeline.duration_s);
    if (std::abs(audio->duration_s() - timeline.duration_s) > 1.0 / settings.mean_rate_hz)
      progress.warn(message("the sound lasts ", audio->duration_s(), " s and the pictures ", timeline.duration_s,
                            " s: it was ",
                            audio->duration_s() > timeline.duration_s ? "cut" : "filled up with silence"));
  }
  std::optional<Mp4Writer> writer;
  std::shared_ptr<const Image> first;
  std::size_t sound_sent = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::shared_ptr<const Image> image = frames.at(i);
    if (!first) first = image;
    check_picture(*image, *first, frames.id(i), frames.id(0));
    if (!writer) {
      settings.width_px = image->width;
      settings.height_px = image->height;
      settings.channels = image->channels;
      writer.emplace(settings);
    }
    const double end_s = i + 1 < frames.size() ? timeline.time_s[i + 1] : timeline.duration_s;
    // The first picture also shows before its time, so that there is no gap at the start.
    writer->add_picture(*image, i == 0 ? 0.0 : timeline.time_s[i], end_s);
    if (!sound.empty()) {
      const std::size_t until =
          std::min(sound.size(), static_cast<std::size_t>(std::llround(end_s * settings.audio_rate_hz)));
      if (until > sound_sent)
        writer->add_sound(sound.data() + sound_sent, static_cast<std::int64_t>(until - sound_sent));
      sound_sent = std::max(sound_sent, until);
    }
    check(!progress.stop_requested(), "stopped");
    progress.report(static_cast<double>(i + 1) / count);
  }
  std::string bytes = writer->finish();
  return settings.path.empty() ? engine::File::from_bytes(std::move(bytes), ".mp4") : engine::File::at(settings.path);
}

}  // namespace face::exports
