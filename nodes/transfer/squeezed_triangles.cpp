// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/squeezed_triangles.h"

#include <cstddef>
#include <cstdint>

namespace face::transfer {

std::vector<render::ScreenPoint> places_in_picture(const Mesh& mesh, const Image& picture) {
  std::vector<render::ScreenPoint> places;
  for (const Vec2f& uv : mesh.uvs)
    places.push_back(
        {uv[0] * static_cast<float>(picture.width) - 0.5f, (1 - uv[1]) * static_cast<float>(picture.height) - 0.5f, 1});
  return places;
}

std::vector<bool> squeezed_triangles(const std::vector<render::Triangle>& triangles,
                                     const std::vector<render::ScreenPoint>& before,
                                     const std::vector<render::ScreenPoint>& now, double least_area) {
  const auto twice_area = [](const render::Triangle& t, const std::vector<render::ScreenPoint>& at) {
    const auto &a = at[t[0]], &b = at[t[1]], &c = at[t[2]];
    return static_cast<double>((b.x_px - a.x_px) * (c.y_px - a.y_px) - (c.x_px - a.x_px) * (b.y_px - a.y_px));
  };
  std::vector<double> share;
  for (const render::Triangle& t : triangles)
    share.push_back(twice_area(t, now) / twice_area(t, before) >= least_area ? 0 : 1);
  // Twice the mean of what is about a vertex, for every triangle.
  for (int ring = 0; ring < 2; ++ring) {
    std::vector<double> sum(before.size(), 0), count(before.size(), 0);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (const std::uint32_t v : triangles[i]) {
        sum[v] += share[i];
        ++count[v];
      }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      share[i] = 0;
      for (const std::uint32_t v : triangles[i]) share[i] += sum[v] / count[v] / 3;
    }
  }
  std::vector<bool> squeezed;
  for (const double s : share) squeezed.push_back(s > 0.5);
  return squeezed;
}

}  // namespace face::transfer
