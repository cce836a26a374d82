// SPDX-License-Identifier: Apache-2.0
// Five pictures that a structured-light projector shows: what a scanner's phantom projects and its decoder undoes.
#pragma once
#include <cmath>
#include <cstddef>
#include <numbers>

namespace face {

// Fringes over the projector's columns. Pictures 1, 2 and 3 are fine fringes, each a third of a period further;
// pictures 0 and 4 are the cosine and sine of coarse ones, with the same mean and amplitude, so that their phase
// follows from those of the fine ones (phase shifting and temporal unwrapping: Zuo et al., Phase shifting algorithms
// for fringe projection profilometry: A review, Optics and Lasers in Engineering 109, 2018; this arrangement of five is
// ours). The fine ones are in the middle of the time, about the moment of picture 2.
struct FringePatterns {
  static constexpr std::size_t count = 5;
  int projector_width_px = 1024;
  int fine_periods = 32;   // over the projector's width
  int coarse_periods = 3;  // over the projector's width; which of them it is follows from the depth's range

  double fine_period_px() const { return static_cast<double>(projector_width_px) / fine_periods; }
  double coarse_period_px() const { return static_cast<double>(projector_width_px) / coarse_periods; }

  // Light of a picture at a projector column, in [0, 1].
  double light(std::size_t picture, double x_px) const {
    constexpr double turn = 2 * std::numbers::pi;
    if (picture == 0) return 0.5 + 0.5 * std::cos(turn * x_px / coarse_period_px());
    if (picture == 4) return 0.5 + 0.5 * std::sin(turn * x_px / coarse_period_px());
    return 0.5 + 0.5 * std::cos(turn * (x_px / fine_period_px() + (static_cast<double>(picture) - 2) / 3));
  }
};

}  // namespace face
