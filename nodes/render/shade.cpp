// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/shade.h"

#include "nodes/base/srgb.h"

namespace face::render {
namespace {

constexpr Vec3f skin_wrap = {0.35f, 0.18f, 0.12f};

void add_wrapped(const Light& light, const Vec3f& normal, float scatter, Vec3f& sum) {
  const float cosine = dot(normal, light.direction);
  for (std::size_t c = 0; c < 3; ++c) {
    const float wrap = scatter * skin_wrap[c];
    const float share = std::max(0.0f, (cosine + wrap) / (1.0f + wrap));
    sum[c] += light.colour[c] * share / (1.0f + wrap);  // the second division keeps the energy
  }
}

}  // namespace

Vec3f diffuse_light(const Vec3f& normal, float scatter) {
  Vec3f sum = {0, 0, 0};
  add_wrapped(key_light, normal, scatter, sum);
  add_wrapped(fill_light, normal, scatter, sum);
  const float grazing = std::max(0.0f, dot(normal, rim_light.direction));
  const float up = 0.5f + 0.5f * normal[1];
  for (std::size_t c = 0; c < 3; ++c) {
    sum[c] += rim_light.colour[c] * grazing * grazing;  // squared: no edge where it begins
    sum[c] += ground_light[c] + (sky_light[c] - ground_light[c]) * up;
  }
  return sum;
}

SrgbTable::SrgbTable() : linear_(linear_size + 2), encoded_(encoded_size + 1) {
  for (int i = 0; i < linear_size + 2; ++i)
    linear_[static_cast<std::size_t>(i)] = static_cast<float>(linear_of(static_cast<double>(i) / linear_size));
  // Filled from the thresholds of the 8-bit codes: 256 powers and not 16,384.
  int code = 0;
  double threshold = linear_of(0.5 / 255.0);
  for (int i = 0; i <= encoded_size; ++i) {
    while (code < 255 && static_cast<double>(i) / encoded_size >= threshold)
      threshold = linear_of((++code + 0.5) / 255.0);
    encoded_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(code);
  }
}

}  // namespace face::render
