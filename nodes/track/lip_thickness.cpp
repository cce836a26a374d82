// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/lip_thickness.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"
#include "nodes/base/quantile.h"

namespace face::track {
namespace {

// Of a line across the mouth, from the outer edge of the upper lip to that of the lower one.
struct LipPoints {
  const Landmark *above = nullptr, *inner_above = nullptr, *inner_below = nullptr, *below = nullptr;

  bool all() const { return above && inner_above && inner_below && below; }
  bool valid() const { return all() && above->valid && below->valid && inner_above->valid && inner_below->valid; }
};

LipPoints lip_points(const Landmarks& landmarks, int line) {
  const auto point = [&](const char* kind, int number) {
    return find_landmark(landmarks, kind + std::to_string(number));
  };
  return {point("lip_", line + 1), point("inner_lip_", line), point("inner_lip_", 8 - line), point("lip_", 11 - line)};
}

// Moves a point towards another until it is as far from it as this share of before.
void approach(Landmark& point, const Landmark& to, double share) {
  point.x_px = to.x_px + share * (point.x_px - to.x_px);
  point.y_px = to.y_px + share * (point.y_px - to.y_px);
}

}  // namespace

Landmarks lip_thickness(const engine::Seq<Landmarks>& landmarks, const Landmarks& rest,
                        const LipThicknessOptions& options) {
  std::vector<double> uppers, lowers;  // as shares of rest
  for (std::size_t t = 0; t < landmarks.size(); ++t) {
    const auto here = landmarks.at(t);
    for (int line = 1; line <= 3; ++line) {
      const LipPoints at_rest = lip_points(rest, line), now = lip_points(*here, line);
      if (!at_rest.all() || !now.valid()) continue;
      const double upper_px = distance_px(*at_rest.above, *at_rest.inner_above);
      const double lower_px = distance_px(*at_rest.below, *at_rest.inner_below);
      if (upper_px <= 0 || lower_px <= 0) continue;
      if (distance_px(*now.inner_above, *now.inner_below) <= options.open_share * distance_px(*now.above, *now.below))
        continue;
      uppers.push_back(distance_px(*now.above, *now.inner_above) / upper_px);
      lowers.push_back(distance_px(*now.below, *now.inner_below) / lower_px);
    }
  }
  Landmarks result = rest;
  if (uppers.empty()) return result;
  const auto share_of = [&](std::vector<double> shares) {
    return std::clamp(quantile(std::move(shares), options.thin_share), options.least_share, 1.0);
  };
  const double upper = share_of(std::move(uppers)), lower = share_of(std::move(lowers));
  for (int line = 1; line <= 3; ++line) {
    const LipPoints at_rest = lip_points(rest, line);
    if (!at_rest.all()) continue;
    approach(result.points[landmark_index(rest, at_rest.inner_above->name)], *at_rest.above, upper);
    approach(result.points[landmark_index(rest, at_rest.inner_below->name)], *at_rest.below, lower);
  }
  return result;
}

}  // namespace face::track
