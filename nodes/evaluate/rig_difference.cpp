// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/rig_difference.h"

#include <algorithm>
#include <string>

#include "nodes/evaluate/statistics.h"
#include "nodes/evaluate/vertex_distances.h"

namespace face::evaluate {
namespace {

const Shape* shape_of(const Rig& rig, const std::string& name) {
  for (const Shape& shape : rig.shapes)
    if (shape.name == name) return &shape;
  return nullptr;
}

std::vector<Vec3f> offsets_of(const Shape* shape, std::size_t vertices) {
  std::vector<Vec3f> offsets(vertices, {0, 0, 0});
  if (shape)
    for (std::size_t i = 0; i < shape->vertices.size() && i < shape->offsets_mm.size(); ++i)
      if (shape->vertices[i] < vertices) offsets[shape->vertices[i]] = shape->offsets_mm[i];
  return offsets;
}

Rig posed(const Rig& rig, const Shape* shape) {
  Rig made;
  made.neutral = rig.neutral;
  made.inner_lips = rig.inner_lips;
  made.landmarks68 = rig.landmarks68;
  const std::vector<Vec3f> offsets = offsets_of(shape, rig.neutral.points_mm.size());
  for (std::size_t v = 0; v < offsets.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c) made.neutral.points_mm[v][c] += offsets[v][c];
  return made;
}

}  // namespace

RigDifferenceResult rig_difference(const Rig& a, const Rig& b) {
  const VertexDistances neutral = vertex_distances(a.neutral.points_mm, b.neutral.points_mm);
  RigDifferenceResult result{{distance_columns, {{"all", {}}, {"neutral", distance_values(neutral)}}}, {}};
  std::vector<double> all = neutral.mm;
  std::string worst;
  double worst_mm = 0;
  std::vector<double> worst_distances = neutral.mm;
  if (neutral.matched) {
    std::vector<std::string> names;
    for (const Shape& shape : a.shapes) names.push_back(shape.name);
    for (const Shape& shape : b.shapes)
      if (!shape_of(a, shape.name)) names.push_back(shape.name);
    const std::size_t vertices = a.neutral.points_mm.size();
    for (const double mm : neutral.mm) worst_mm = std::max(worst_mm, mm);
    for (const std::string& name : names) {
      const VertexDistances distances =
          vertex_distances(offsets_of(shape_of(a, name), vertices), offsets_of(shape_of(b, name), vertices));
      const double largest = largest_of(distances.mm);
      all.insert(all.end(), distances.mm.begin(), distances.mm.end());
      if (!(largest > 0)) continue;
      result.table.rows.push_back({name, distance_values(distances)});
      if (largest > worst_mm) worst = name, worst_mm = largest, worst_distances = distances.mm;
    }
  }
  result.table.rows[0].values = distance_values({all, neutral.matched});
  result.picture = worst.empty()
                       ? draw_distances(posed(a, nullptr), posed(b, nullptr), neutral.mm)
                       : draw_distances(posed(a, shape_of(a, worst)), posed(b, shape_of(b, worst)), worst_distances);
  return result;
}

}  // namespace face::evaluate
