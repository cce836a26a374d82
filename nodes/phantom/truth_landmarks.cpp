// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/truth_landmarks.h"

#include <cmath>
#include <string>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/base/clip_points.h"
#include "nodes/phantom/head_view.h"

namespace face::phantom {
namespace {

std::string two_digits(std::size_t number) { return (number < 10 ? "0" : "") + std::to_string(number); }

// Names and indices into landmarks68.
std::vector<std::pair<std::string, std::size_t>> points_of(LandmarkSet set) {
  std::vector<std::pair<std::string, std::size_t>> points;
  if (set == LandmarkSet::multipie68) {
    for (std::size_t i = 0; i < 68; ++i) points.emplace_back(two_digits(i), i);
    return points;
  }
  for (const auto& [name, number] : clip_points) points.emplace_back(name, number);
  return points;
}

}  // namespace

Landmarks truth_landmarks(const Rig& rig, const Weights& weights, const RigidMotion* world_from_head,
                          const Camera& camera, const TruthLandmarksOptions& options) {
  constexpr float hidden_mm = 3;
  check(rig.landmarks68.size() == 68, "the rig names ", rig.landmarks68.size(), " landmarks, expected 68");
  const HeadView view = view_head(rig, weights, world_from_head, camera, options.width_px, options.height_px);
  Landmarks landmarks;
  for (const auto& [name, index] : points_of(options.set)) {
    const std::uint32_t vertex = rig.landmarks68[index];
    check(vertex < view.screen.size(), "landmark ", index, " is vertex ", vertex, ", but the mesh has ",
          view.screen.size());
    const render::ScreenPoint& at = view.screen[vertex];
    const float column = std::floor(at.x_px + 0.5f), row = std::floor(at.y_px + 0.5f);
    bool seen = at.depth_mm > 0 && column >= 0 && row >= 0 && column < static_cast<float>(options.width_px) &&
                row < static_cast<float>(options.height_px);
    if (seen) {
      const float shown =
          view.raster.inverse_depth_per_mm[view.raster.index(static_cast<int>(column), static_cast<int>(row))];
      seen = shown == 0 || at.depth_mm <= 1 / shown + hidden_mm;
    }
    landmarks.points.push_back({name, at.x_px, at.y_px, seen});
  }
  return landmarks;
}

}  // namespace face::phantom
