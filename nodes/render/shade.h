// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/types/vec.h"

namespace face::render {

// A point of a surface, as the renderer interpolates it. Colours are linear.
struct Surface {
  Vec3f position_mm = {0, 0, 0};
  Vec3f normal = {0, 0, 1};
  Vec3f albedo = {0.8f, 0.8f, 0.8f};
  float gloss = 0;      // as Part::gloss
  float exposure = 1;   // share of the surroundings that the point sees: 1 outside, towards 0 deep in the mouth
  float scatter = 0;    // 1 for skin: light wraps round, red the most
};

// Linear colour towards the eye, from a soft portrait set: a key light from the upper left of the picture, a weaker cool
// fill from the right, a rim light from behind and a sky above a warm ground. Made for a head that faces +z.
// Diffuse light wraps past the terminator per channel as light does under skin (the wrap of Green, Real-Time
// Approximations to Subsurface Scattering, GPU Gems 2004); highlights are Blinn's (1977) with Schlick's Fresnel (1994).
Vec3f shade(const Surface& surface, const Vec3f& eye_mm);

// Conversions of IEC 61966-2-1 by table: to 8 bits exact to half a step above black.
class SrgbTable {
 public:
  SrgbTable();
  float linear(float srgb) const;             // srgb in [0, 1], clamped
  std::uint8_t encoded(float linear) const;   // linear in [0, 1], clamped

 private:
  std::vector<float> linear_;
  std::vector<std::uint8_t> encoded_;
};

}  // namespace face::render
