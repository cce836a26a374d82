// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/shade.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace face::render {
namespace {

struct Light {
  Vec3f direction;  // unit, towards the light
  Vec3f colour;     // linear
};

// Unit vectors (rounded), x to the right of the picture.
constexpr Light key = {{-0.4000f, 0.4500f, 0.7984f}, {0.92f, 0.88f, 0.82f}};
constexpr Light fill = {{0.7071f, 0.1000f, 0.7000f}, {0.20f, 0.22f, 0.26f}};
constexpr Light rim = {{0.6500f, 0.4000f, -0.6461f}, {0.45f, 0.50f, 0.60f}};
constexpr Vec3f sky = {0.27f, 0.29f, 0.33f};
constexpr Vec3f ground = {0.16f, 0.12f, 0.10f};
constexpr Vec3f skin_wrap = {0.35f, 0.18f, 0.12f};

float dot(const Vec3f& a, const Vec3f& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec3f normalized(const Vec3f& v) {
  const float squared = dot(v, v);
  const float inverse = squared > 0 ? 1.0f / std::sqrt(squared) : 0.0f;
  return {v[0] * inverse, v[1] * inverse, v[2] * inverse};
}

// cosine^(2^doublings), without a call to pow.
float power_of_two(float cosine, int doublings) {
  for (int i = 0; i < doublings; ++i) cosine *= cosine;
  return cosine;
}

void add_diffuse(const Light& light, const Vec3f& normal, float scatter, Vec3f& sum) {
  const float cosine = dot(normal, light.direction);
  for (std::size_t c = 0; c < 3; ++c) {
    const float wrap = scatter * skin_wrap[c];
    const float wrapped = std::max(0.0f, (cosine + wrap) / (1.0f + wrap));
    sum[c] += light.colour[c] * wrapped / (1.0f + wrap);  // the second division keeps the energy
  }
}

float highlight(const Light& light, const Vec3f& normal, const Vec3f& view, float gloss, int doublings) {
  if (dot(normal, light.direction) <= 0) return 0;
  const Vec3f half = normalized({light.direction[0] + view[0], light.direction[1] + view[1], light.direction[2] + view[2]});
  const float cosine = std::max(0.0f, dot(normal, half));
  const float facing = std::max(0.0f, 1.0f - dot(view, half));
  const float squared = facing * facing;
  const float fresnel = 0.04f + 0.96f * squared * squared * facing;
  const auto exponent = static_cast<float>(1 << doublings);
  return gloss * fresnel * (exponent + 2.0f) * 0.125f * power_of_two(cosine, doublings);
}

}  // namespace

Vec3f shade(const Surface& surface, const Vec3f& eye_mm) {
  const Vec3f normal = normalized(surface.normal);
  const Vec3f view = normalized({eye_mm[0] - surface.position_mm[0], eye_mm[1] - surface.position_mm[1],
                                 eye_mm[2] - surface.position_mm[2]});
  Vec3f diffuse = {0, 0, 0};
  add_diffuse(key, normal, surface.scatter, diffuse);
  add_diffuse(fill, normal, surface.scatter, diffuse);
  const float grazing = std::max(0.0f, dot(normal, rim.direction));
  for (std::size_t c = 0; c < 3; ++c) diffuse[c] += rim.colour[c] * grazing * grazing;  // squared: no edge where it begins
  const float up = 0.5f + 0.5f * normal[1];
  for (std::size_t c = 0; c < 3; ++c) diffuse[c] += ground[c] + (sky[c] - ground[c]) * up;
  const int doublings = 3 + static_cast<int>(surface.gloss * 5.5f);  // exponents 8 to 256
  const float key_highlight = highlight(key, normal, view, surface.gloss, doublings);
  const float fill_highlight = highlight(fill, normal, view, surface.gloss, doublings);
  const float rim_highlight = highlight(rim, normal, view, 0.25f + 0.75f * surface.gloss, 3);
  Vec3f colour;
  for (std::size_t c = 0; c < 3; ++c) {
    const float specular = key.colour[c] * key_highlight + fill.colour[c] * fill_highlight + rim.colour[c] * rim_highlight;
    colour[c] = surface.exposure * (surface.albedo[c] * diffuse[c] + specular);
  }
  return colour;
}

namespace {
constexpr int linear_size = 1024;
constexpr int encoded_size = 16384;

double to_linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}
}  // namespace

SrgbTable::SrgbTable() : linear_(linear_size + 2), encoded_(encoded_size + 1) {
  for (int i = 0; i < linear_size + 2; ++i)
    linear_[static_cast<std::size_t>(i)] = static_cast<float>(to_linear(static_cast<double>(i) / linear_size));
  // Filled from the thresholds of the 8-bit codes: 256 powers and not 16,384.
  int code = 0;
  double threshold = to_linear(0.5 / 255.0);
  for (int i = 0; i <= encoded_size; ++i) {
    while (code < 255 && static_cast<double>(i) / encoded_size >= threshold) threshold = to_linear((++code + 0.5) / 255.0);
    encoded_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(code);
  }
}

float SrgbTable::linear(float srgb) const {
  const float position = std::clamp(srgb, 0.0f, 1.0f) * linear_size;
  const auto index = static_cast<std::size_t>(position);
  const float fraction = position - static_cast<float>(index);
  return linear_[index] + fraction * (linear_[index + 1] - linear_[index]);
}

std::uint8_t SrgbTable::encoded(float linear) const {
  return encoded_[static_cast<std::size_t>(std::clamp(linear, 0.0f, 1.0f) * encoded_size)];
}

}  // namespace face::render
