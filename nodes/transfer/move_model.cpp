// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/move_model.h"

#include <algorithm>
#include <set>

#include "nodes/base/check.h"
#include "nodes/model/region_pca.h"
#include "nodes/transfer/lip_sides.h"
#include "nodes/transfer/mesh_graph.h"

namespace face::transfer {

ShapeModel move_model(const ShapeModel& model, const MeshPoints& from, const MeshPoints& to) {
  check(from.points_mm.size() == model.vertices && to.points_mm.size() == model.vertices, "from has ",
        from.points_mm.size(), " points, to ", to.points_mm.size(), ", the model ", model.vertices);
  check(model.mean_mm.size() == 3 * model.vertices, "the model's mean has ", model.mean_mm.size(),
        " numbers, expected 3 for each of its ", model.vertices, " vertices");
  ShapeModel out = model;
  for (std::size_t v = 0; v < model.vertices; ++v)
    for (std::size_t k = 0; k < 3; ++k)
      out.mean_mm[3 * v + k] += static_cast<double>(to.points_mm[v][k]) - static_cast<double>(from.points_mm[v][k]);
  return out;
}

ShapeModel rest_model(const ShapeModel& model, const MeshPoints& rest) {
  std::vector<double> x;
  for (const Vec3f& p : rest.points_mm)
    for (const float value : p) x.push_back(static_cast<double>(value));
  ShapeModel out = model;
  out.mean_mm = model::shape_of(model, model::coefficients_of(model, x));
  return out;
}

ShapeModel freeze_edges(const ShapeModel& model, const Mesh& mesh, const FreezeEdgesOptions& options) {
  check(mesh.points_mm.size() == model.vertices, "mesh has ", mesh.points_mm.size(), " points, the model ",
        model.vertices);
  check(model.modes.size() == model.size() * 3 * model.vertices, "the model's modes have ", model.modes.size(),
        " numbers, expected ", model.size() * 3 * model.vertices, " for ", model.size(), " components");
  const MouthOpening mouth = find_mouth_opening(mesh);
  std::set<std::uint32_t> lips(mouth.upper.begin(), mouth.upper.end());
  lips.insert(mouth.lower.begin(), mouth.lower.end());
  if (mouth.found()) lips.insert({mouth.right_corner, mouth.left_corner});
  std::set<std::uint32_t> edge;
  for (const auto& [a, b] : open_edges(mesh)) {
    if (!lips.contains(a)) edge.insert(a);
    if (!lips.contains(b)) edge.insert(b);
  }
  const std::vector<float> distance = distances_from(neighbours_of(mesh), mesh.points_mm, {edge.begin(), edge.end()},
                                                     static_cast<float>(options.width_mm));
  ShapeModel out = model;
  for (std::size_t v = 0; v < model.vertices; ++v) {
    const double s =
        options.width_mm > 0 ? std::clamp(static_cast<double>(distance[v]) / options.width_mm, 0.0, 1.0) : 1;
    const double share = s * s * (3 - 2 * s);
    for (std::size_t k = 0; k < model.size(); ++k)
      for (std::size_t a = 0; a < 3; ++a) out.modes[(k * model.vertices + v) * 3 + a] *= share;
  }
  return out;
}

}  // namespace face::transfer
