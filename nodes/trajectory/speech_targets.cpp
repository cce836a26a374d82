// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/speech_targets.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "nodes/base/check.h"
#include "nodes/types/arkit.h"

namespace face::trajectory {
namespace {

// Pull of a frame that no phone covers: keeps the system solvable, too weak to be seen.
constexpr double least_precision = 1e-3;
constexpr double reference_length_s = 0.1;
// Vowels shorter than this may pass without opening.
constexpr double shortest_open_s = 0.08;

void check_phones(const Phones& phones) {
  double end_s = 0;
  for (std::size_t i = 0; i < phones.phones.size(); ++i) {
    const Phone& phone = phones.phones[i];
    check(std::isfinite(phone.start_s) && std::isfinite(phone.end_s) && phone.start_s >= end_s - 1e-6 &&
              phone.end_s >= phone.start_s,
          "phone ", i, " (", phone.label, ") runs from ", phone.start_s, " to ", phone.end_s,
          " s, expected phones in order, after ", end_s, " s");
    end_s = phone.end_s;
  }
}

double length_factor(Normalise normalise, double length_s, double utterance_s) {
  if (normalise == Normalise::utterance) return std::max(0.05, 1 - length_s / utterance_s);
  if (normalise == Normalise::duration) return reference_length_s / std::max(length_s, 0.01);
  return 1;
}

// First frame at or after a time, and first at or after it, of `frames`. The nanosecond absorbs sums of phone lengths
// that should land on a frame.
std::size_t frame_from(double time_s, double rate_hz, std::size_t frames) {
  const double frame = std::ceil((time_s - 1e-9) * rate_hz);
  return static_cast<std::size_t>(std::clamp(frame, 0.0, static_cast<double>(frames)));
}

std::vector<std::size_t> frames_between(double start_s, double end_s, double rate_hz, std::size_t frames) {
  std::vector<std::size_t> found;
  for (std::size_t i = frame_from(start_s, rate_hz, frames); i < frame_from(end_s, rate_hz, frames); ++i)
    found.push_back(i);
  return found;
}

std::size_t nearest_frame(double time_s, double rate_hz, std::size_t frames) {
  return static_cast<std::size_t>(std::clamp(std::round(time_s * rate_hz), 0.0, static_cast<double>(frames - 1)));
}

// Frames of [start, end) without its edges; else all of it; else the frame of [start, last) nearest to the middle of
// [start, end); else the nearest of all.
std::vector<std::size_t> contact_frames(double start_s, double end_s, double last_s, double edge_s, double rate_hz,
                                        std::size_t frames) {
  std::vector<std::size_t> found = frames_between(start_s + edge_s, end_s - edge_s, rate_hz, frames);
  if (found.empty()) found = frames_between(start_s, end_s, rate_hz, frames);
  if (!found.empty()) return found;
  const double middle_s = (start_s + end_s) / 2;
  found = frames_between(start_s, last_s, rate_hz, frames);
  if (found.empty()) return {nearest_frame(middle_s, rate_hz, frames)};
  return {found.front()};  // all of them lie after the middle
}

}  // namespace

std::size_t frame_count(const Phones& phones, double rate_hz) {
  double duration_s = phones.duration_s;
  if (!phones.phones.empty()) duration_s = std::max(duration_s, phones.phones.back().end_s);
  check(std::isfinite(duration_s) && duration_s >= 0, "the speech lasts ", duration_s, " s, expected 0 or more");
  return static_cast<std::size_t>(std::max(1.0, std::ceil((duration_s - 1e-9) * rate_hz)));
}

const Viseme& find_viseme(const Visemes& visemes, const std::string& label, std::size_t phone) {
  const std::string whole = label.substr(0, label.find('.'));
  for (const std::string& name : {label, whole})
    for (const Viseme& viseme : visemes.visemes)
      if (viseme.label == name) return viseme;
  fail("phone ", phone, " is \"", label, "\", which the viseme table does not have");
}

TrajectoryTargets speech_targets(const Phones& phones, const Visemes& visemes, const SpeechTargetsOptions& options) {
  check_phones(phones);
  TrajectoryTargets targets;
  targets.frames = frame_count(phones, options.rate_hz);
  targets.dims = arkit_count;
  targets.precision.assign(targets.frames * arkit_count, 0.0);
  targets.target.assign(targets.frames * arkit_count, 0.0);  // the sum of precision x weight until the end

  const auto pull = [&](double start_s, double end_s, const std::vector<float>& weights, const Viseme& viseme,
                        double factor) {
    // In units of frames, cell i is [i - 1/2, i + 1/2).
    const double start = start_s * options.rate_hz + 0.5, end = end_s * options.rate_hz + 0.5;
    for (auto i = static_cast<std::size_t>(start); i < targets.frames && static_cast<double>(i) < end; ++i) {
      const double cell = static_cast<double>(i);
      const double share = std::min(end, cell + 1) - std::max(start, cell);
      if (share <= 0) continue;
      for (std::size_t k = 0; k < arkit_count; ++k) {
        const double precision = factor * share / (double{viseme.sigmas[k]} * viseme.sigmas[k]);
        targets.precision[i * arkit_count + k] += precision;
        targets.target[i * arkit_count + k] += precision * std::clamp(options.strength * weights[k], 0.0, 1.0);
      }
    }
  };
  for (std::size_t i = 0; i < phones.phones.size(); ++i) {
    const Phone& phone = phones.phones[i];
    const Viseme& viseme = find_viseme(visemes, phone.label, i);
    check(viseme.weights.size() == arkit_count && viseme.sigmas.size() == arkit_count, "viseme ", viseme.label, " has ",
          viseme.weights.size(), " weights and ", viseme.sigmas.size(), " sigmas, expected ", arkit_count);
    const double length_s = phone.end_s - phone.start_s;
    const double factor = length_factor(options.normalise, length_s, phones.duration_s);
    const bool glides = !viseme.glide_weights.empty();
    const double turn_s = glides ? phone.start_s + viseme.glide_from * length_s : phone.end_s;
    pull(phone.start_s, turn_s, viseme.weights, viseme, factor);
    if (glides) pull(turn_s, phone.end_s, viseme.glide_weights, viseme, factor);
  }
  for (std::size_t i = 0; i < targets.precision.size(); ++i) {
    targets.target[i] = targets.precision[i] > 0 ? targets.target[i] / targets.precision[i] : 0.0;
    targets.precision[i] = std::max(targets.precision[i], least_precision);
  }
  return targets;
}

std::vector<Contact> find_contacts(const Phones& phones, const Visemes& visemes, double rate_hz) {
  const std::size_t frames = frame_count(phones, rate_hz);
  std::vector<Contact> contacts;
  for (std::size_t i = 0; i < phones.phones.size(); ++i) {
    const Phone& phone = phones.phones[i];
    const Viseme& viseme = find_viseme(visemes, phone.label, i);
    const double length_s = phone.end_s - phone.start_s;
    if (viseme.contact == "lips") {
      // The release follows the closure: an unsplit stop is closed for its first part only (what split_stops assumes,
      // too).
      const bool unsplit = phone.label == "P" || phone.label == "B";
      const double end_s = unsplit ? phone.start_s + 0.6 * length_s : phone.end_s;
      double last_s = phone.end_s;
      if (phone.label.ends_with(".c") && i + 1 < phones.phones.size() && phones.phones[i + 1].label.ends_with(".r"))
        last_s = phones.phones[i + 1].end_s;
      const double edge_s = std::min(0.01, 0.15 * (end_s - phone.start_s));
      contacts.push_back(
          {ContactKind::lips, i, contact_frames(phone.start_s, end_s, last_s, edge_s, rate_hz, frames), 0});
    } else if (viseme.contact == "teeth") {
      contacts.push_back({ContactKind::teeth, i,
                          contact_frames(phone.start_s, phone.end_s, phone.end_s, length_s / 4, rate_hz, frames), 0});
    } else if (viseme.open_mm > 0 && length_s >= shortest_open_s - 1e-9) {
      // The two frames about the middle, so that it holds there at any rate.
      const double middle = (phone.start_s + phone.end_s) / 2 * rate_hz;
      const auto first = static_cast<std::size_t>(std::min(middle, static_cast<double>(frames - 1)));
      contacts.push_back({ContactKind::open, i, {first, std::min(first + 1, frames - 1)}, viseme.open_mm});
    }
  }
  return contacts;
}

}  // namespace face::trajectory
