// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/scan_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/model/skin_modes.h"
#include "nodes/render/triangulate.h"

namespace face::model {

void check_surface(const MorphableModel& surface) {
  const Mesh& mesh = surface.mean;
  const std::size_t vertices = mesh.points_mm.size();
  const auto in_range = [&](std::uint32_t v) { return v < vertices; };
  check(std::all_of(mesh.corners.begin(), mesh.corners.end(), in_range), "surface has a corner beyond its ", vertices,
        " vertices");
  for (std::size_t f = 0; f < mesh.polygon_starts.size(); ++f)
    check(mesh.polygon_starts[f] <= mesh.corners.size() &&
              (f == 0 || mesh.polygon_starts[f] >= mesh.polygon_starts[f - 1]),
          "surface has polygon ", f, " at corner ", mesh.polygon_starts[f], ", but ", mesh.corners.size(), " corners");
  for (const Part& part : mesh.parts)
    check(static_cast<std::size_t>(part.first_polygon) + part.polygon_count <= mesh.polygon_count(),
          "surface has part \"", part.name, "\" up to polygon ",
          static_cast<std::size_t>(part.first_polygon) + part.polygon_count, " of ", mesh.polygon_count());
  check(std::all_of(surface.landmarks68.begin(), surface.landmarks68.end(), in_range),
        "surface has a landmark beyond its ", vertices, " vertices");
  check(mesh.uvs.size() == vertices && mesh.colors_srgb.size() == vertices, "surface has ", mesh.uvs.size(),
        " uvs and ", mesh.colors_srgb.size(), " colours, expected one for each of its ", vertices,
        " vertices: is it of model.scan_template?");
  for (std::size_t v = 0; v < vertices; ++v) {
    const Vec3f& p = mesh.points_mm[v];
    check(std::isfinite(p[0] + p[1] + p[2] + mesh.uvs[v][0] + mesh.uvs[v][1]), "surface has a vertex ", v,
          " that is not finite");
  }
}

std::size_t skin_count(const MorphableModel& surface) {
  check_surface(surface);
  std::size_t count = 0;
  const std::vector<bool> skin = skin_vertices(surface.mean);
  while (count < skin.size() && skin[count]) ++count;
  return count;
}

std::vector<std::uint32_t> mouth_loop(const MorphableModel& surface) {
  const std::size_t skin = skin_count(surface);
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> edges;
  for (const render::Triangle& t : render::triangulate(surface.mean).triangles) {
    if (t[0] >= skin || t[1] >= skin || t[2] >= skin) continue;
    for (std::size_t k = 0; k < 3; ++k) edges[{t[k], t[(k + 1) % 3]}] = true;
  }
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [edge, present] : edges)
    if (present && !edges.contains({edge.second, edge.first})) next[edge.first] = edge.second;
  // The boundary loop that comes nearest to all inner lip points.
  std::vector<std::uint32_t> best;
  double least = 1e30;
  while (!next.empty() && surface.landmarks68.size() == 68) {
    std::vector<std::uint32_t> loop;
    for (std::uint32_t v = next.begin()->first; next.contains(v);) {
      loop.push_back(v);
      const std::uint32_t to = next[v];
      next.erase(v);
      v = to;
    }
    double farthest = 0;
    for (std::size_t i = 60; i < 68; ++i) {
      const Vec3f& mark = surface.mean.points_mm[surface.landmarks68[i]];
      double nearest = 1e30;
      for (const std::uint32_t v : loop) {
        const Vec3f& p = surface.mean.points_mm[v];
        nearest = std::min<double>(nearest, std::hypot(p[0] - mark[0], p[1] - mark[1], p[2] - mark[2]));
      }
      farthest = std::max(farthest, nearest);
    }
    if (loop.size() > 8 && farthest < least) {
      least = farthest;
      best = std::move(loop);
    }
  }
  constexpr double reach_mm = 8;
  return least < reach_mm ? best : std::vector<std::uint32_t>();
}

std::vector<LipPair> lip_pairs(const MorphableModel& surface, const std::vector<std::uint32_t>& loop) {
  std::map<float, LipPair> pairs;
  const std::vector<Vec2f>& uvs = surface.mean.uvs;
  for (const std::uint32_t v : loop) {
    const auto [it, fresh] = pairs.try_emplace(uvs[v][0], LipPair{v, v});
    if (fresh) continue;
    if (uvs[v][1] > uvs[it->second.upper][1]) it->second.upper = v;
    if (uvs[v][1] < uvs[it->second.lower][1]) it->second.lower = v;
  }
  std::vector<LipPair> all;
  for (const auto& [u, pair] : pairs)
    if (pair.upper != pair.lower) all.push_back(pair);
  return all;
}

}  // namespace face::model
