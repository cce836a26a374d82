// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/speech_samples.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/random.h"

namespace face::speech {
namespace {

constexpr double peak_level = 20000;  // of 32767
constexpr double dither_level = 2;
constexpr double silent_peak = 2.0 / 32768;
constexpr double speech_range_db = 50;  // quieter than the loudest frame by more than this is silence
constexpr int margin_frames = 20;       // kept before and after speech

}  // namespace

SpeechSamples prepare_samples(const Audio& audio) {
  SpeechSamples prepared;
  const auto frames = static_cast<int>(audio.samples.size() / samples_per_frame);
  prepared.end_frame = frames;
  // A high-pass (first difference over the frame) measures loudness, so that an offset or hum does not count.
  std::vector<double> energy(static_cast<std::size_t>(frames), 0.0);
  double mean = 0;
  for (const float s : audio.samples) mean += s;
  mean /= std::max<double>(1, static_cast<double>(audio.samples.size()));
  double peak = 0;
  for (const float s : audio.samples) peak = std::max(peak, std::abs(s - mean));
  prepared.silent = peak <= silent_peak;
  const double gain = prepared.silent ? 0 : peak_level / peak;
  for (std::size_t i = 1; i < audio.samples.size() && i < energy.size() * samples_per_frame; ++i) {
    const double d = gain * (double{audio.samples[i]} - audio.samples[i - 1]);
    energy[i / samples_per_frame] += d * d;
  }
  const double loudest = energy.empty() ? 0 : *std::max_element(energy.begin(), energy.end());
  const double floor = loudest * std::pow(10.0, -speech_range_db / 10);
  const auto loud = [&](double e) { return e > floor; };
  const auto first = std::find_if(energy.begin(), energy.end(), loud);
  const auto last = std::find_if(energy.rbegin(), energy.rend(), loud);
  prepared.first_frame = std::max(0, static_cast<int>(first - energy.begin()) - margin_frames);
  prepared.end_frame = std::min(frames, frames - static_cast<int>(last - energy.rbegin()) + margin_frames);
  prepared.samples.reserve(audio.samples.size());
  for (std::size_t i = 0; i < audio.samples.size(); ++i) {
    // The noise counts from where speech starts: silence put before a recording does not change it.
    const auto position = static_cast<std::int64_t>(i) - std::int64_t{prepared.first_frame} * samples_per_frame;
    Random random(1, static_cast<std::uint64_t>(position));
    const double dither = dither_level * (random.uniform() - random.uniform());
    prepared.samples.push_back(
        static_cast<std::int16_t>(std::clamp(std::lround(gain * (audio.samples[i] - mean) + dither), -32768L, 32767L)));
  }
  return prepared;
}

}  // namespace face::speech
