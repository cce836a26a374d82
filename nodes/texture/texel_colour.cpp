// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/texel_colour.h"

#include <algorithm>
#include <cstddef>

namespace face::texture {

Vec3f colour_at(const AlbedoMap& map, const Vec2f& uv) {
  const auto width = static_cast<float>(map.width), height = static_cast<float>(map.height);
  const float x = std::clamp(uv[0] * width - 0.5f, 0.0f, width - 1.001f);
  const float y = std::clamp((1 - uv[1]) * height - 0.5f, 0.0f, height - 1.001f);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  Vec3f sum{};
  float weight = 0;
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const Vec3f& value = map.albedo[static_cast<std::size_t>(y0 + dy) * static_cast<std::size_t>(map.width) +
                                      static_cast<std::size_t>(x0 + dx)];
      const float share = (dx == 1 ? fx : 1 - fx) * (dy == 1 ? fy : 1 - fy);
      if (value[0] <= 0) continue;  // outside the atlas
      weight += share;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += share * value[c];
    }
  if (weight > 0)
    for (float& v : sum) v /= weight;
  return sum;
}

}  // namespace face::texture
