// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/skin_points.h"

#include <algorithm>

#include "nodes/render/camera.h"
#include "nodes/render/triangulate.h"

namespace face::model {

DrawnSkin draw_skin(const SkinBasis& basis, const std::vector<Vec3f>& posed_mm, const FacePose& pose,
                    const PictureLevel& level) {
  DrawnSkin drawn;
  drawn.screen = render::project(camera_of(scaled(pose, level.factor)), posed_mm);
  render::RasterOptions options;
  options.width_px = level.width;
  options.height_px = level.height;
  drawn.raster = render::rasterize(drawn.screen, basis.triangles, options);
  return drawn;
}

std::vector<SkinPoint> choose_points(const SkinBasis& basis, const std::vector<Vec3f>& posed_mm, const FacePose& pose,
                                     const PictureLevel& level, std::size_t points, Random& random,
                                     std::size_t& visible) {
  return choose_points(basis, draw_skin(basis, posed_mm, pose, level), points, random, visible);
}

std::vector<SkinPoint> choose_points(const SkinBasis& basis, const DrawnSkin& drawn, std::size_t points, Random& random,
                                     std::size_t& visible) {
  const render::Raster& raster = drawn.raster;
  std::vector<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < raster.triangles.size(); ++i)
    if (raster.triangles[i] >= 0) seen.push_back(i);
  visible = seen.size();
  std::vector<SkinPoint> chosen(std::min(points, seen.size()));
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    // A partial shuffle (Durstenfeld, Algorithm 235: Random Permutation, 1964).
    const std::size_t pick = n + static_cast<std::size_t>(random.uniform() * static_cast<double>(seen.size() - n));
    std::swap(seen[n], seen[pick]);
    const auto width = static_cast<std::uint32_t>(raster.width_px);
    chosen[n].triangle = static_cast<std::uint32_t>(raster.triangles[seen[n]]);
    chosen[n].weights =
        render::barycentrics_at(drawn.screen, basis.triangles[chosen[n].triangle], static_cast<float>(seen[n] % width),
                                static_cast<float>(seen[n] / width));
  }
  // Neighbours after each other share what they read of modes and picture, which is most of the time they take.
  std::sort(chosen.begin(), chosen.end(),
            [](const SkinPoint& a, const SkinPoint& b) { return a.triangle < b.triangle; });
  return chosen;
}

}  // namespace face::model
