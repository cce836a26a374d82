// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/render/rasterize.h"
#include "nodes/types/mesh.h"

namespace face::render {

struct Triangulation {
  std::vector<Triangle> triangles;      // vertices
  std::vector<std::uint32_t> polygons;  // that every triangle comes from
  std::vector<std::uint16_t> parts;     // that every triangle belongs to; 0 for a mesh without parts
};

// Cuts every polygon into a fan about its first corner. Polygons of invisible parts are left out unless all are wanted.
Triangulation triangulate(const Mesh& mesh, bool visible_only = true);

// Unit vertex normals: the area-weighted mean of the triangles around each vertex, 0 where there is none.
// points_mm: V x 3, which need not be the mesh's own (a pose).
std::vector<Vec3f> vertex_normals(const std::vector<Vec3f>& points_mm, const std::vector<Triangle>& triangles);

}  // namespace face::render
