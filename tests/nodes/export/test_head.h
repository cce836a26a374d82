// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/arkit.h"
#include "nodes/types/rig.h"

namespace test {

// A square of two parts (a quad with a texture seam down its middle) with the 52 shapes; only jawOpen and mouthClose
// move anything.
inline face::Rig square_rig() {
  face::Rig rig;
  rig.neutral.points_mm = {{-10, 0, 0}, {0, 0, 0}, {10, 0, 0}, {-10, 20, 0}, {0, 20, 0}, {10, 20, 5}};
  rig.neutral.corners = {0, 1, 4, 3, 1, 2, 5, 4};
  rig.neutral.polygon_starts = {0, 4, 8};
  rig.neutral.uvs = {{0, 0}, {0.5f, 0}, {0.6f, 0}, {1, 0}, {0, 1}, {0.5f, 1}, {0.6f, 1}, {1, 1}};
  rig.neutral.corner_uvs = {0, 1, 5, 4, 2, 3, 7, 6};
  rig.neutral.colors_srgb.assign(6, {1.0f, 0.5f, 0.25f});
  rig.neutral.parts = {{"face", 0, 1, {0.8f, 0.6f, 0.5f}, 0.2f, true}, {"lashes", 1, 1, {0.1f, 0.1f, 0.1f}, 0, true}};
  for (const std::string_view name : face::arkit_names) rig.shapes.push_back({std::string(name), {}, {}});
  rig.shapes[face::arkit_index("jawOpen")] = {"jawOpen", {0, 1, 2}, {{0, -5, 0}, {0, -6, 1}, {0, -5, 0}}};
  rig.shapes[face::arkit_index("mouthClose")] = {"mouthClose", {1}, {{0, 2, 0}}};
  rig.inner_lips = {{4, 1}};
  rig.lower_lip = {1, 2};
  rig.upper_teeth = {3};
  rig.missing = {"tongueOut"};
  return rig;
}

}  // namespace test
