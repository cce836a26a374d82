// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

#include "nodes/types/rig.h"

namespace test {

// A rig that is its 68 landmarks alone, without shapes: lips on a ring, eyes and nose above, jaw below.
inline face::Rig landmark_rig() {
  face::Rig rig;
  rig.neutral.points_mm.resize(68, {0, 0, 0});
  for (std::uint32_t i = 0; i < 68; ++i) rig.landmarks68.push_back(i);
  auto& points = rig.neutral.points_mm;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const double angle = 2 * std::numbers::pi * i / 12;
    points[48 + i] = {static_cast<float>(-25 * std::cos(angle)), static_cast<float>(8 * std::sin(angle)), 0};
  }
  points[39] = {-16, 60, 0};
  points[42] = {16, 60, 0};
  points[30] = {0, 30, 10};
  for (std::uint32_t i = 0; i < 3; ++i) points[7 + i] = {20 * (static_cast<float>(i) - 1), -45, 0};
  return rig;
}

}  // namespace test
