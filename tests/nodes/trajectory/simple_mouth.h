// SPDX-License-Identifier: Apache-2.0
// A head of fourteen vertices: two lips of three, and a plate of upper teeth behind them. Enough to close and to bite.
#pragma once
#include <string_view>
#include <vector>

#include "nodes/types/arkit.h"
#include "nodes/types/rig.h"

namespace test {

inline void set_shape(face::Rig& rig, std::string_view name, face::Vec3f upper, face::Vec3f lower) {
  face::Shape& shape = rig.shapes[face::arkit_index(name)];
  for (std::uint32_t v = 0; v < 6; ++v) {
    shape.vertices.push_back(v);
    shape.offsets_mm.push_back(v < 3 ? upper : lower);
  }
}

// Offsets in the size of a real head's. Vertices 0-2 upper lip, 3-5 lower lip, 6-13 the teeth: a box from 3 mm above
// the mouth's line to 1 mm below it, its front 5 mm behind the lips.
inline face::Rig simple_mouth() {
  face::Rig rig;
  rig.neutral.points_mm = {{-8, 0.5f, 100}, {0, 0.5f, 100}, {8, 0.5f, 100}, {-8, -0.5f, 100}, {0, -0.5f, 100},
                           {8, -0.5f, 100}, {-12, -1, 95},  {12, -1, 95},   {12, 3, 95},      {-12, 3, 95},
                           {-12, -1, 92},   {12, -1, 92},   {12, 3, 92},    {-12, 3, 92}};
  for (const std::uint32_t corner :
       {6u, 7u, 8u, 9u, 11u, 10u, 13u, 12u, 7u, 11u, 12u, 8u, 10u, 6u, 9u, 13u, 9u, 8u, 12u, 13u, 10u, 11u, 7u, 6u})
    rig.neutral.corners.push_back(corner);
  for (std::uint32_t f = 0; f <= 6; ++f) rig.neutral.polygon_starts.push_back(4 * f);
  for (const std::string_view name : face::arkit_names) rig.shapes.push_back({std::string(name), {}, {}});
  set_shape(rig, "jawOpen", {0, -3, 0}, {0, -33, -18});
  set_shape(rig, "mouthClose", {0, 0, 2}, {0, 37, 16});
  set_shape(rig, "mouthFunnel", {0, 4, 7}, {0, -7, 8});
  set_shape(rig, "mouthPucker", {0, -1, 8}, {0, 1, 10});
  set_shape(rig, "mouthRollLower", {0, 0, 0}, {0, 2.5f, -11});
  set_shape(rig, "mouthRollUpper", {0, 1.5f, -10}, {0, 0, 0});
  set_shape(rig, "mouthShrugLower", {0, 0, 0}, {0, 6, 5});
  set_shape(rig, "mouthPressLeft", {0, 0, 0}, {0, 1, 0.5f});
  set_shape(rig, "mouthPressRight", {0, 0, 0}, {0, 1, 0.5f});
  set_shape(rig, "mouthUpperUpLeft", {0, 4, 0}, {0, 0.3f, 0});
  set_shape(rig, "mouthUpperUpRight", {0, 4, 0}, {0, 0.3f, 0});
  set_shape(rig, "mouthLowerDownLeft", {0, 0, 0}, {0, -3, -0.5f});
  set_shape(rig, "mouthLowerDownRight", {0, 0, 0}, {0, -3, -0.5f});
  rig.inner_lips = {{0, 3}, {1, 4}, {2, 5}};
  rig.lower_lip = {3, 4, 5};
  rig.upper_teeth = {6, 7, 8, 9, 10, 11, 12, 13};
  return rig;
}

}  // namespace test
