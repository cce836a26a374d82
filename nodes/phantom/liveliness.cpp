// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/liveliness.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "nodes/phantom/person_random.h"
#include "nodes/phantom/vector3.h"

namespace face::phantom {
namespace {

bool is_vowel(std::string_view label) {
  return !label.empty() && std::string_view("AEIOU").find(label[0]) != std::string_view::npos;
}

// The longest vowel of every word: phones carry no stress.
std::vector<double> prominent_vowels(const Phones& phones) {
  std::vector<double> middles;
  const std::vector<Phone>& list = phones.phones;
  std::size_t k = 0;
  while (k < list.size()) {
    std::size_t end = k + 1;
    while (end < list.size() && list[end].word == list[k].word && !list[k].word.empty()) ++end;
    double longest_s = 0.06, middle_s = -1;
    for (std::size_t i = k; i < end; ++i) {
      const double length_s = list[i].end_s - list[i].start_s;
      if (!is_vowel(list[i].label) || length_s <= longest_s) continue;
      longest_s = length_s;
      middle_s = 0.5 * (list[i].start_s + list[i].end_s);
    }
    if (middle_s >= 0) middles.push_back(middle_s);
    k = end;
  }
  return middles;
}

// Lids close in 80 ms, stay 30 ms and open in 160 ms (after Evinger, Manning and Sibony, Eyelid Movements:
// Mechanisms and Normal Data, Investigative Ophthalmology and Visual Science, 1991).
double lid(double since_s) {
  constexpr double kDown_s = 0.08, kShut_s = 0.03, kUp_s = 0.16;
  if (since_s < 0 || since_s > kDown_s + kShut_s + kUp_s) return 0;
  if (since_s < kDown_s) return smooth_step(0, kDown_s, since_s);
  return smooth_step(kDown_s + kShut_s + kUp_s, kDown_s + kShut_s, since_s);
}

// A gesture about a time: up in 0.22 s, down in 0.45 s.
double swell(double since_s) { return since_s < 0 ? smooth_step(-0.22, 0, since_s) : smooth_step(0.45, 0, since_s); }

}  // namespace

Liveliness::Liveliness(const Phones& phones, double end_s, std::int64_t seed, const Amounts& amounts)
    : amounts_(amounts) {
  Random blink = series(seed, 12), gaze = series(seed, 13), accent = series(seed, 14), body = series(seed, 15);
  for (double t = blink.uniform(0.4, 2.5); t < end_s; t += 0.9 + 2.6 * std::exp(0.55 * blink.normal()))
    blinks_.push_back({t, blink.uniform(0.92, 1)});
  for (double t = -1; t < end_s; t += gaze.uniform(0.5, 2.4)) {
    // Half of the time at the viewer.
    const bool at_viewer = gaze.uniform() < 0.5;
    const double left = gaze.normal(), up = gaze.normal();
    fixations_.push_back({t, (at_viewer ? 0.8 : 7.0) * left, (at_viewer ? 0.6 : 3.5) * up});
  }
  for (const double t : prominent_vowels(phones)) {
    const double kind = accent.uniform(), size = accent.uniform(0.4, 1);
    if (kind < 0.35) brows_.push_back({t, size});
    if (kind > 0.88) frowns_.push_back({t, size});
    if (accent.uniform() < 0.55) nods_.push_back({t + 0.05, accent.uniform(0.5, 1)});
  }
  // Pitch, yaw, roll in degrees, then x, y, z in mm.
  constexpr std::array<double, 6> kSize = {1.6, 2.5, 1.1, 2.2, 1.0, 2.2};
  for (std::size_t axis = 0; axis < sway_.size(); ++axis)
    for (Wave& wave : sway_[axis]) {
      const double per_s = std::exp(body.uniform(std::log(0.09), std::log(0.6)));
      // Slow sway is wide, quick sway small.
      wave = {2 * std::numbers::pi * per_s, body.uniform(0, 2 * std::numbers::pi),
              kSize[axis] * std::min(1.0, 0.15 / per_s)};
    }
}

double Liveliness::sway(const std::array<Wave, 4>& waves, double time_s) {
  double sum = 0;
  for (const Wave& wave : waves) sum += wave.size * std::sin(wave.per_s * time_s + wave.phase);
  return sum;
}

Life Liveliness::at(double time_s) const {
  Life life;
  for (const Event& event : blinks_) life.blink = std::max(life.blink, event.size * lid(time_s - event.time_s));
  for (const Event& event : brows_) {
    life.brow_inner = std::max(life.brow_inner, 0.45 * event.size * swell(time_s - event.time_s));
    life.brow_outer = std::max(life.brow_outer, 0.40 * event.size * swell(time_s - event.time_s));
  }
  for (const Event& event : frowns_)
    life.brow_down = std::max(life.brow_down, 0.35 * event.size * swell(time_s - event.time_s));
  for (double* brow : {&life.brow_inner, &life.brow_outer, &life.brow_down}) *brow *= amounts_.brows;

  double nod = 0;
  for (const Event& event : nods_) nod = std::max(nod, event.size * swell(time_s - event.time_s));
  life.pitch_deg = amounts_.head * (sway(sway_[0], time_s) - 3.0 * nod);
  life.yaw_deg = amounts_.head * sway(sway_[1], time_s);
  life.roll_deg = amounts_.head * sway(sway_[2], time_s);
  for (std::size_t k = 0; k < 3; ++k) life.shift_mm[k] = amounts_.head * sway(sway_[3 + k], time_s);

  // From fixation to fixation within 45 ms; the eyes turn against the head to hold their point.
  double left = 0, up = 0;
  for (std::size_t k = 0; k < fixations_.size(); ++k) {
    const double arrived = k == 0 ? 1 : smooth_step(0, 0.045, time_s - fixations_[k].from_s);
    left = lerp(left, fixations_[k].left_deg, arrived);
    up = lerp(up, fixations_[k].up_deg, arrived);
  }
  life.look_left_deg = amounts_.gaze * (left - life.yaw_deg);
  life.look_up_deg = amounts_.gaze * (up - life.pitch_deg);
  return life;
}

}  // namespace face::phantom
