// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "nodes/phantom/vector3.h"
#include "nodes/types/mesh.h"

namespace face::phantom {

// A run of vertices.
struct VertexRange {
  std::uint32_t first = 0, end = 0;
};

// A mesh under construction that knows the mirror image of each of its vertices.
struct HeadBuilder {
  std::vector<Vector3> points_mm;
  std::vector<Vector3> colors_srgb;    // as many
  std::vector<std::uint32_t> mirror;   // vertex at (-x, y, z); a vertex of the middle plane is its own
  std::vector<std::uint32_t> corners;  // as in Mesh
  std::vector<std::uint32_t> polygon_starts = {0};
  std::vector<Part> parts;

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(points_mm.size()); }

  // Appends a vertex, its own mirror image until pair() says otherwise.
  std::uint32_t add_vertex(Vector3 point_mm, Vector3 color_srgb);
  void pair(std::uint32_t a, std::uint32_t b);
  // Appends a polygon, counter-clockwise from outside, leaving out repeated corners; nothing is added below three.
  void add_polygon(std::initializer_list<std::uint32_t> vertices);
  // Polygons added from here on belong to this part.
  void begin_part(const std::string& name, Vector3 albedo_srgb, double gloss);
  // Copies the polygons of the current part and their vertices, from the given first ones, to the other side as a new
  // part.
  void add_mirror_image(const std::string& name, std::uint32_t first_vertex, std::uint32_t first_polygon);

  // Makes left and right exact mirror images: the left one counts.
  void symmetrise();
  Mesh to_mesh() const;
};

// A grid of vertices row by row, each row `columns` long; quads face the side where rows run up and columns run right.
// `closed` joins the last column to the first.
void add_grid(HeadBuilder& head, std::uint32_t first, std::uint32_t rows, std::uint32_t columns, bool closed);

}  // namespace face::phantom
