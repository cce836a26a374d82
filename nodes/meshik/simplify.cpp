// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/simplify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/meshik/bind_surface.h"
#include "nodes/meshik/collapse_set.h"
#include "nodes/meshik/mesh_triangles.h"

namespace face::meshik {
namespace {

constexpr std::uint32_t gone = std::numeric_limits<std::uint32_t>::max();

// Which triangles of the fans belong to which part of the mesh; parts.size() where to none.
std::vector<std::uint32_t> parts_of_triangles(const Mesh& mesh) {
  std::vector<std::uint32_t> part_of_polygon(mesh.polygon_count(), static_cast<std::uint32_t>(mesh.parts.size()));
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p)
    for (std::uint32_t i = 0; i < mesh.parts[p].polygon_count; ++i)
      if (mesh.parts[p].first_polygon + i < part_of_polygon.size())
        part_of_polygon[mesh.parts[p].first_polygon + i] = p;
  std::vector<std::uint32_t> found;
  for (std::size_t f = 0; f < mesh.polygon_count(); ++f)
    for (std::uint32_t c = mesh.polygon_starts[f] + 2; c < mesh.polygon_starts[f + 1]; ++c)
      found.push_back(part_of_polygon[f]);
  return found;
}

double importance(const Rig& rig, const Vec3f& point, const SimplifyOptions& options) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 36; i < 68 && rig.landmarks68.size() == 68; ++i) {
    const Vec3f& there = rig.neutral.points_mm[rig.landmarks68[i]];
    double square = 0;
    for (std::size_t d = 0; d < 3; ++d)
      square += std::pow(static_cast<double>(point[d]) - static_cast<double>(there[d]), 2);
    nearest = std::min(nearest, square);
  }
  return 1 + options.detail * std::exp(-nearest / (2 * options.detail_mm * options.detail_mm));
}

std::vector<std::uint32_t> left_of(const std::vector<std::uint32_t>& vertices, const std::vector<std::uint32_t>& now) {
  std::vector<std::uint32_t> left;
  for (const std::uint32_t v : vertices)
    if (now[v] != gone) left.push_back(now[v]);
  return left;
}

template <class Value>
std::vector<Value> chosen(const std::vector<Value>& values, const std::vector<std::uint32_t>& vertices) {
  std::vector<Value> made;
  for (const std::uint32_t v : vertices) made.push_back(values[v]);
  return made;
}

}  // namespace

SimplifyResult simplify(const Rig& rig, const engine::Seq<Mesh>& examples, engine::SeqWriter<Mesh>& simple_examples,
                        const SimplifyOptions& options) {
  const Mesh& whole = rig.neutral;
  const std::size_t count = whole.points_mm.size();
  check(count > 0, "the rig has no vertices");
  CollapseSet set;
  set.triangles = fan_triangles(whole);
  set.poses_mm.push_back(whole.points_mm);
  for (std::size_t i = 0; i < examples.size(); ++i) {
    const auto example = examples.at(i);
    check(example->points_mm.size() == count, "example ", examples.id(i), " has ", example->points_mm.size(),
          " vertices, the rig has ", count);
    set.poses_mm.push_back(example->points_mm);
  }
  for (const std::vector<Vec3f>& pose : set.poses_mm)
    for (const Vec3f& point : pose)
      check(std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]), "a vertex is at (", point[0],
            ", ", point[1], ", ", point[2], "), expected finite numbers");
  for (const std::uint32_t v : rig.landmarks68) check(v < count, "a landmark is vertex ", v, ", the rig has ", count);
  for (const Vec3f& point : whole.points_mm) set.importance.push_back(importance(rig, point, options));
  set.keep.assign(count, 0);
  for (const std::uint32_t v : rig.landmarks68) set.keep[v] = 1;
  for (const LipPair& pair : rig.inner_lips) {
    check(pair.upper < count && pair.lower < count, "a pair of the lips is ", pair.upper, " and ", pair.lower,
          ", the rig has ", count, " vertices");
    set.keep[pair.upper] = set.keep[pair.lower] = 1;
  }
  const Collapsed collapsed = collapse_set(set, static_cast<std::size_t>(options.vertices));

  std::vector<bool> used(count, false);
  for (const std::uint32_t v : collapsed.triangles) used[v] = true;
  for (std::size_t v = 0; v < count; ++v) used[v] = used[v] || set.keep[v];
  std::vector<std::uint32_t> kept, now(count, gone);
  for (std::uint32_t v = 0; v < count; ++v)
    if (used[v]) now[v] = static_cast<std::uint32_t>(kept.size()), kept.push_back(v);

  SimplifyResult result;
  result.triangles = static_cast<std::int64_t>(collapsed.faces.size());
  Mesh& mesh = result.rig.neutral;
  mesh.points_mm = chosen(whole.points_mm, kept);
  if (whole.colors_srgb.size() == count) mesh.colors_srgb = chosen(whole.colors_srgb, kept);
  mesh.polygon_starts = {0};
  const std::vector<std::uint32_t> part = parts_of_triangles(whole);
  for (std::size_t f = 0; f < collapsed.faces.size(); ++f) {
    for (std::size_t c = 0; c < 3; ++c) mesh.corners.push_back(now[collapsed.triangles[3 * f + c]]);
    mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    const std::uint32_t p = part[collapsed.faces[f]];
    if (p >= whole.parts.size()) continue;
    // Parts tile the polygons in order, and the faces that are left are in that order.
    if (mesh.parts.empty() || mesh.parts.back().name != whole.parts[p].name) {
      mesh.parts.push_back(whole.parts[p]);
      mesh.parts.back().first_polygon = static_cast<std::uint32_t>(f);
      mesh.parts.back().polygon_count = 0;
    }
    ++mesh.parts.back().polygon_count;
  }
  for (const Shape& shape : rig.shapes) {
    Shape made{shape.name, {}, {}};
    for (std::size_t i = 0; i < shape.vertices.size(); ++i)
      if (now[shape.vertices[i]] != gone)
        made.vertices.push_back(now[shape.vertices[i]]), made.offsets_mm.push_back(shape.offsets_mm[i]);
    result.rig.shapes.push_back(std::move(made));
  }
  result.rig.missing = rig.missing;
  for (const LipPair& pair : rig.inner_lips) result.rig.inner_lips.push_back({now[pair.upper], now[pair.lower]});
  result.rig.lower_lip = left_of(rig.lower_lip, now);
  result.rig.upper_teeth = left_of(rig.upper_teeth, now);
  result.rig.landmarks68 = left_of(rig.landmarks68, now);
  for (std::size_t i = 0; i < examples.size(); ++i) {
    Mesh example = mesh;
    example.points_mm = chosen(set.poses_mm[i + 1], kept);
    simple_examples.push(examples.id(i), std::move(example));
  }
  result.binding = bind_surface(whole.points_mm, set.triangles, collapsed.triangles);
  for (double* row = result.binding.values.data(); row < result.binding.values.data() + result.binding.values.size();
       row += 6)
    for (std::size_t c = 0; c < 3; ++c) row[c] = now[static_cast<std::size_t>(row[c])];
  return result;
}

}  // namespace face::meshik
