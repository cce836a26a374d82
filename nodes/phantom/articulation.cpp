// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/articulation.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/phantom/person_random.h"
#include "nodes/phantom/vector3.h"

namespace face::phantom {
namespace {

constexpr double kExponent = 1.4;          // c of the paper, which has 1: a cusp in the middle of every segment
constexpr double kShortestHold_s = 0.045;  // longer than a frame at 25 per second: every contact is on one
constexpr double kWholeStopShut = 0.65;    // share of a stop that is not split into closure and release

bool is_release(std::string_view label) { return label.ends_with(".r"); }

std::string_view base_label(std::string_view label) { return label.substr(0, label.find('.')); }

Gestures dominance_of(const PhoneGesture& phone) {
  Gestures dominance;
  dominance.fill(phone.lips);
  dominance[kJaw] = phone.jaw;
  dominance[kTongue] = phone.tongue;
  return dominance;
}

}  // namespace

SpeakerStyle speaker_style(std::int64_t seed, double amount) {
  Random random = series(seed, 11);
  const auto vary = [&](double deviation) {
    return std::exp(amount * deviation * std::clamp(random.normal(), -2.0, 2.0));
  };
  SpeakerStyle style;
  style.reach_s *= vary(0.12);
  style.carry_s *= vary(0.12);
  style.jaw *= vary(0.14);
  style.lips *= vary(0.12);
  style.close_s *= vary(0.10);
  style.release_s *= vary(0.10);
  style.press *= vary(0.3);
  style.left *= vary(0.08);
  style.right *= vary(0.08);
  style.smile *= vary(0.5);
  return style;
}

Articulator::Articulator(const Phones& phones, const SpeakerStyle& style) : style_(style) {
  for (std::size_t k = 0; k < phones.phones.size(); ++k) {
    const Phone& phone = phones.phones[k];
    const PhoneGesture* gesture = find_gesture(base_label(phone.label));
    check(gesture != nullptr, "phone ", k, " is \"", phone.label,
          "\", expected an ARPAbet label without stress or SIL");
    const double length_s = phone.end_s - phone.start_s;
    check(length_s >= 0, "phone ", k, " (", phone.label, ") ends at ", phone.end_s, " s, before its start at ",
          phone.start_s, " s");
    const Gestures dominance = dominance_of(*gesture);
    const auto add = [&](double start_s, double end_s, const Gestures& target) {
      // Silence is at rest all through; speech is on its way from one middle to the next.
      const double flat = gesture->label == "SIL" ? 0.85 : 0.3;
      segments_.push_back({0.5 * (start_s + end_s), 0.5 * flat * (end_s - start_s), target, dominance});
    };
    const double half_s = phone.start_s + 0.5 * length_s;
    add(phone.start_s, gesture->second ? half_s : phone.end_s, gesture->target);
    if (gesture->second) add(half_s, phone.end_s, *gesture->second);

    if (gesture->contact == PhoneContact::none || is_release(phone.label)) continue;
    const bool whole_stop =
        gesture->label != "M" && gesture->contact == PhoneContact::lips && phone.label.find('.') == std::string::npos;
    Hold hold = {phone.start_s, phone.start_s + (whole_stop ? kWholeStopShut : 1.0) * length_s};
    const double short_s = std::max(0.0, kShortestHold_s - (hold.end_s - hold.start_s));
    hold = {hold.start_s - 0.5 * short_s, hold.end_s + 0.5 * short_s};
    (gesture->contact == PhoneContact::lips ? closures_ : labiodentals_).push_back(hold);
  }
}

double Articulator::contact(const std::vector<Hold>& holds, double time_s) const {
  double most = 0;
  for (const Hold& hold : holds) {
    const double before_s = hold.start_s - time_s, after_s = time_s - hold.end_s;
    if (before_s > style_.close_s || after_s > style_.release_s) continue;
    most = std::max(most, before_s > 0  ? smooth_step(style_.close_s, 0, before_s)
                          : after_s > 0 ? smooth_step(style_.release_s, 0, after_s)
                                        : 1.0);
  }
  return most;
}

Articulation Articulator::at(double time_s) const {
  Articulation mouth;
  if (segments_.empty()) return mouth;
  const auto fall_of = [&](const Segment& segment) {
    const double from_s = time_s - segment.middle_s;
    const double beyond_s = std::max(0.0, std::abs(from_s) - segment.plateau_s);
    return std::pow(beyond_s / (from_s < 0 ? style_.reach_s : style_.carry_s), kExponent);
  };
  // Segments follow one another, so dominances only fall on the way from the nearest middle to both sides.
  const auto after = std::lower_bound(segments_.begin(), segments_.end(), time_s,
                                      [](const Segment& segment, double t) { return segment.middle_s < t; });
  const auto middle = static_cast<std::size_t>(after - segments_.begin());
  double nearest = 1e300;
  if (middle < segments_.size()) nearest = fall_of(segments_[middle]);
  if (middle > 0) nearest = std::min(nearest, fall_of(segments_[middle - 1]));
  Gestures sum = {}, weights = {};
  // False where a segment no longer counts: far from all, dominances are taken relative to the nearest one.
  const auto add = [&](const Segment& segment) {
    constexpr double kNothing = 40;  // exp(-40) is lost in rounding
    const double fall = fall_of(segment);
    if (fall > nearest + kNothing) return false;
    const double near = std::exp(nearest - fall);
    for (std::size_t g = 0; g < kGestureCount; ++g) {
      const double dominance = segment.dominance[g] * near;  // alpha exp(-theta |tau|^c)
      sum[g] += dominance * segment.target[g];
      weights[g] += dominance;
    }
    return true;
  };
  for (std::size_t k = middle; k > 0 && add(segments_[k - 1]);) --k;
  for (std::size_t k = middle; k < segments_.size() && add(segments_[k]);) ++k;
  for (std::size_t g = 0; g < kGestureCount; ++g)
    mouth.gestures[g] = sum[g] / weights[g] * (g == kJaw ? style_.jaw : g == kTongue ? 1 : style_.lips);
  mouth.lips_shut = contact(closures_, time_s);
  mouth.lip_teeth = contact(labiodentals_, time_s) * (1 - mouth.lips_shut);
  return mouth;
}

}  // namespace face::phantom
