// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/head_builder.h"

namespace face::phantom {

std::uint32_t HeadBuilder::add_vertex(Vector3 point_mm, Vector3 color_srgb) {
  points_mm.push_back(point_mm);
  colors_srgb.push_back(color_srgb);
  mirror.push_back(vertex_count() - 1);
  return vertex_count() - 1;
}

void HeadBuilder::pair(std::uint32_t a, std::uint32_t b) {
  mirror[a] = b;
  mirror[b] = a;
}

void HeadBuilder::add_polygon(std::initializer_list<std::uint32_t> vertices) {
  const std::size_t before = corners.size();
  for (const std::uint32_t vertex : vertices) {
    bool repeated = false;
    for (std::size_t i = before; i < corners.size(); ++i) repeated = repeated || corners[i] == vertex;
    if (!repeated) corners.push_back(vertex);
  }
  if (corners.size() < before + 3) {
    corners.resize(before);
    return;
  }
  polygon_starts.push_back(static_cast<std::uint32_t>(corners.size()));
  ++parts.back().polygon_count;
}

void HeadBuilder::begin_part(const std::string& name, Vector3 albedo_srgb, double gloss) {
  Part part;
  part.name = name;
  part.first_polygon = static_cast<std::uint32_t>(polygon_starts.size() - 1);
  part.albedo_srgb = to_float(albedo_srgb);
  part.gloss = static_cast<float>(gloss);
  parts.push_back(part);
}

void HeadBuilder::add_mirror_image(const std::string& name, std::uint32_t first_vertex, std::uint32_t first_polygon) {
  const std::uint32_t vertices = vertex_count();
  const std::size_t polygons = polygon_starts.size() - 1;
  const Part model = parts.back();
  for (std::uint32_t v = first_vertex; v < vertices; ++v) pair(v, add_vertex(mirrored(points_mm[v]), colors_srgb[v]));
  begin_part(name, {model.albedo_srgb[0], model.albedo_srgb[1], model.albedo_srgb[2]}, model.gloss);
  for (std::size_t f = first_polygon; f < polygons; ++f) {
    for (std::uint32_t i = polygon_starts[f + 1]; i > polygon_starts[f]; --i) corners.push_back(mirror[corners[i - 1]]);
    polygon_starts.push_back(static_cast<std::uint32_t>(corners.size()));
    ++parts.back().polygon_count;
  }
}

void HeadBuilder::symmetrise() {
  for (std::uint32_t v = 0; v < vertex_count(); ++v) {
    const std::uint32_t other = mirror[v];
    if (other == v) points_mm[v].x = 0;
    if (points_mm[v].x > 0) {
      points_mm[other] = mirrored(points_mm[v]);
      colors_srgb[other] = colors_srgb[v];
    }
  }
}

Mesh HeadBuilder::to_mesh() const {
  Mesh mesh;
  for (const Vector3& point : points_mm) mesh.points_mm.push_back(to_float(point));
  for (const Vector3& color : colors_srgb) mesh.colors_srgb.push_back(to_float(color));
  mesh.corners = corners;
  mesh.polygon_starts = polygon_starts;
  mesh.parts = parts;
  return mesh;
}

void add_grid(HeadBuilder& head, std::uint32_t first, std::uint32_t rows, std::uint32_t columns, bool closed) {
  for (std::uint32_t r = 0; r + 1 < rows; ++r)
    for (std::uint32_t c = 0; c + (closed ? 0 : 1) < columns; ++c) {
      const std::uint32_t d = (c + 1) % columns, row = first + r * columns, next = row + columns;
      head.add_polygon({row + c, row + d, next + d, next + c});
    }
}

}  // namespace face::phantom
