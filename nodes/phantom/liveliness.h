// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "nodes/types/phones.h"

namespace face::phantom {

// What a speaker does beside speaking, at one time. Angles in degrees.
struct Life {
  double blink = 0;  // 1 = lids shut
  double brow_inner = 0, brow_outer = 0, brow_down = 0;
  double look_left_deg = 0, look_up_deg = 0;        // of the eyes in the head
  double pitch_deg = 0, yaw_deg = 0, roll_deg = 0;  // of the head: up, to its left, its top to its left
  std::array<double, 3> shift_mm = {0, 0, 0};
};

// Functions of time that a seed and the phones decide.
class Liveliness {
 public:
  struct Amounts {
    double brows = 1, gaze = 1, head = 1;
  };
  Liveliness(const Phones& phones, double end_s, std::int64_t seed, const Amounts& amounts);
  Life at(double time_s) const;

 private:
  struct Event {
    double time_s, size;
  };
  struct Fixation {
    double from_s, left_deg, up_deg;
  };
  struct Wave {
    double per_s, phase, size;
  };
  static double sway(const std::array<Wave, 4>& waves, double time_s);

  Amounts amounts_;
  std::vector<Event> blinks_, brows_, frowns_, nods_;
  std::vector<Fixation> fixations_;
  std::array<std::array<Wave, 4>, 6> sway_;
};

}  // namespace face::phantom
