// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/types/vec.h"

namespace face::render {

inline float dot(const Vec3f& a, const Vec3f& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Vec3f normalized(const Vec3f& v) {
  const float squared = dot(v, v);
  const float inverse = squared > 0 ? 1.0f / std::sqrt(squared) : 0.0f;
  return {v[0] * inverse, v[1] * inverse, v[2] * inverse};
}

struct Light {
  Vec3f direction;  // unit, towards the light
  Vec3f colour;     // linear
};

// A soft portrait set for a head that faces +z: a key light from the upper left of the picture, a weaker cool fill from
// the right, a rim light from behind and a sky above a warm ground.
inline constexpr Light key_light = {{-0.4000f, 0.4500f, 0.7984f}, {0.95f, 0.90f, 0.83f}};
inline constexpr Light fill_light = {{0.7071f, 0.1000f, 0.7000f}, {0.20f, 0.22f, 0.26f}};
inline constexpr Light rim_light = {{0.6500f, 0.4000f, -0.6461f}, {0.55f, 0.60f, 0.70f}};
inline constexpr Vec3f sky_light = {0.25f, 0.27f, 0.31f};
inline constexpr Vec3f ground_light = {0.15f, 0.115f, 0.095f};

// Linear light that a surface with this unit normal scatters, per unit of albedo. scatter: 1 for skin, where light
// wraps past the terminator, red the most, as it does in skin (the wrap of Green, Real-Time Approximations to
// Subsurface Scattering, GPU Gems 2004); 0 for Lambert's law. It varies slowly, so it is found at vertices and
// interpolated.
Vec3f diffuse_light(const Vec3f& normal, float scatter);

// Mirrored key and fill light on a glossy surface, linear, white. gloss as in Part. Blinn's highlight (1977) with
// Schlick's Fresnel term (1994). Neither vector need be of unit length.
inline float highlight(const Light& light, const Vec3f& unit_normal, const Vec3f& unit_view, float gloss,
                       int doublings) {
  if (dot(unit_normal, light.direction) <= 0) return 0;
  const Vec3f half = normalized(
      {light.direction[0] + unit_view[0], light.direction[1] + unit_view[1], light.direction[2] + unit_view[2]});
  float cosine = std::max(0.0f, dot(unit_normal, half));
  const float facing = std::max(0.0f, 1.0f - dot(unit_view, half));
  const float squared = facing * facing;
  const float fresnel = 0.04f + 0.96f * squared * squared * facing;
  const auto exponent = static_cast<float>(1 << doublings);
  for (int i = 0; i < doublings; ++i) cosine *= cosine;  // cosine^(2^doublings) without a call to pow
  return gloss * fresnel * (exponent + 2.0f) * 0.125f * cosine;
}

inline Vec3f highlights(const Vec3f& normal, const Vec3f& view, float gloss) {
  const Vec3f unit_normal = normalized(normal), unit_view = normalized(view);
  const int doublings = 3 + static_cast<int>(gloss * 5.5f);  // exponents 8 to 256
  const float from_key = highlight(key_light, unit_normal, unit_view, gloss, doublings);
  const float from_fill = highlight(fill_light, unit_normal, unit_view, gloss, doublings);
  Vec3f sum;
  for (std::size_t c = 0; c < 3; ++c) sum[c] = key_light.colour[c] * from_key + fill_light.colour[c] * from_fill;
  return sum;
}

// Conversions of IEC 61966-2-1 by table: to 8 bits exact to half a step above black.
class SrgbTable {
 public:
  SrgbTable();
  // srgb in [0, 1], clamped.
  float linear(float srgb) const {
    const float position = std::clamp(srgb, 0.0f, 1.0f) * static_cast<float>(linear_size);
    const auto index = static_cast<std::size_t>(position);
    const float fraction = position - static_cast<float>(index);
    return linear_[index] + fraction * (linear_[index + 1] - linear_[index]);
  }
  // linear in [0, 1], clamped.
  std::uint8_t encoded(float linear) const {
    return encoded_[static_cast<std::size_t>(std::clamp(linear, 0.0f, 1.0f) * static_cast<float>(encoded_size))];
  }

 private:
  static constexpr int linear_size = 1024;
  static constexpr int encoded_size = 16384;
  std::vector<float> linear_;
  std::vector<std::uint8_t> encoded_;
};

}  // namespace face::render
