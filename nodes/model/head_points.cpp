// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/head_points.h"

#include <algorithm>

#include "nodes/base/check.h"
#include "nodes/model/add_teeth.h"
#include "nodes/model/scan_surface.h"

namespace face::model {

std::vector<Follower> followers(const MorphableModel& surface) {
  const std::size_t skin = skin_count(surface), all = surface.mean.points_mm.size();
  std::vector<Follower> result(all - skin);
  const auto each = [&](const Part& part, const auto& set) {
    for (std::size_t c = surface.mean.polygon_starts[part.first_polygon];
         c < surface.mean.polygon_starts[part.first_polygon + part.polygon_count]; ++c)
      if (const std::uint32_t v = surface.mean.corners[c]; v >= skin) set(v);
  };
  const std::vector<std::uint32_t> loop = mouth_loop(surface);
  for (const Part& part : surface.mean.parts) {
    if (part.name == lower_teeth_part && surface.landmarks68.size() == 68)
      each(part, [&](std::uint32_t v) { result[v - skin] = {surface.landmarks68[8], 1.0f}; });
    if (part.name != mouth_part || loop.empty()) continue;
    std::uint32_t first = static_cast<std::uint32_t>(all);
    each(part, [&](std::uint32_t v) { first = std::min(first, v); });
    each(part, [&](std::uint32_t v) {
      const std::size_t ring = (v - first) / loop.size();
      if (ring < mouth_rings.size()) result[v - skin] = {loop[(v - first) % loop.size()], mouth_rings[ring].follows};
    });
  }
  return result;
}

std::vector<Vec3f> head_points(const MorphableModel& surface, const std::vector<Vec3f>& skin_mm) {
  const std::size_t skin = skin_count(surface);
  check(skin_mm.size() == skin, "shape has ", skin_mm.size(), " vertices, the surface's skin has ", skin);
  std::vector<Vec3f> points = skin_mm;
  const std::vector<Follower> rest = followers(surface);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    Vec3f p = surface.mean.points_mm[skin + i];
    for (std::size_t axis = 0; axis < 3; ++axis)
      p[axis] += rest[i].share * (skin_mm[rest[i].skin][axis] - surface.mean.points_mm[rest[i].skin][axis]);
    points.push_back(p);
  }
  return points;
}

}  // namespace face::model
