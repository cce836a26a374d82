// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/vec.h"

namespace face {

// The light on a face and what a camera makes of it: one parallel and one ambient light, then colour contrast, gain and
// offset (Blanz and Vetter, Face Recognition Based on Fitting a 3D Morphable Model, PAMI 2003, section 4.1). A surface
// of albedo T and unit normal n is seen as
//   L_c = (ambient_c + parallel_c * max(0, n . towards_light)) * T_c
//   I_c = gain_c * (contrast * L_c + (1 - contrast) * luminance(L)) + offset_c
// with luminance(L) = 0.3 L_r + 0.59 L_g + 0.11 L_b, albedo and I in [0, 1].
struct Lighting {
  Vec3f ambient = {0.4f, 0.4f, 0.4f};
  Vec3f parallel = {0.6f, 0.6f, 0.6f};
  Vec3f towards_light = {0, 0, 1};  // unit, in the world
  float contrast = 1;               // 1 = as it is, 0 = grey
  Vec3f gain = {1, 1, 1};
  Vec3f offset = {0, 0, 0};
};

}  // namespace face
