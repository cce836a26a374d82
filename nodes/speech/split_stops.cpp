// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/split_stops.h"

#include <algorithm>
#include <cmath>

#include "nodes/speech/arpabet.h"

namespace face::speech {
namespace {

constexpr double closure_share = 0.6;  // where nothing is heard
constexpr double shortest_closure_s = 0.020;
constexpr double longest_closure_s = 0.150;
constexpr double shortest_release_s = 0.005;
constexpr double step_s = 0.001;
constexpr double side_s = 0.006;  // energy before and after a candidate

// Energy of the first difference (a high-pass: voicing through the closure stays low) in [from_s, to_s).
double band_energy(const Audio& audio, double from_s, double to_s) {
  const auto count = static_cast<std::ptrdiff_t>(audio.samples.size());
  const std::ptrdiff_t first = std::clamp<std::ptrdiff_t>(std::lround(from_s * audio.rate_hz), 1, count);
  const std::ptrdiff_t last = std::clamp<std::ptrdiff_t>(std::lround(to_s * audio.rate_hz), 1, count);
  double sum = 0;
  for (std::ptrdiff_t i = first; i < last; ++i) {
    const double d =
        double{audio.samples[static_cast<std::size_t>(i)]} - audio.samples[static_cast<std::size_t>(i - 1)];
    sum += d * d;
  }
  return last > first ? sum / static_cast<double>(last - first) : 0;
}

double find_burst(const Audio* audio, const Phone& stop) {
  const double length_s = stop.end_s - stop.start_s;
  const double fallback_s = stop.start_s + closure_share * length_s;
  const double first_s = stop.start_s + shortest_closure_s, last_s = stop.end_s - shortest_release_s;
  if (!audio || last_s - first_s < 2 * step_s) return fallback_s;
  constexpr double floor = 1e-10;  // 16-bit quantisation noise
  double best_s = fallback_s, best_rise = 0;
  const int steps = static_cast<int>((last_s - first_s) / step_s);
  for (int i = 0; i <= steps; ++i) {
    const double t = first_s + i * step_s;
    const double rise =
        std::log((band_energy(*audio, t, t + side_s) + floor) / (band_energy(*audio, t - side_s, t) + floor));
    if (rise > best_rise) best_rise = rise, best_s = t;
  }
  return best_s;
}

}  // namespace

Phones split_stops(const Phones& phones, const Audio* audio) {
  Phones split = phones;
  split.phones.clear();
  for (const Phone& phone : phones.phones) {
    if (!is_stop(phone.label)) {
      split.phones.push_back(phone);
      continue;
    }
    Phone closure = phone, release = phone;
    double burst_s = find_burst(audio, phone);
    if (burst_s - closure.start_s > longest_closure_s) {
      if (!split.phones.empty() && split.phones.back().label == "SIL")
        split.phones.back().end_s = closure.start_s = burst_s - longest_closure_s;
      else
        burst_s = closure.start_s + longest_closure_s;
    }
    closure.label += ".c";
    closure.end_s = release.start_s = burst_s;
    release.label += ".r";
    split.phones.push_back(std::move(closure));
    split.phones.push_back(std::move(release));
  }
  return split;
}

}  // namespace face::speech
