// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/render/rasterize.h"
#include "nodes/render/triangulate.h"
#include "nodes/types/mesh.h"

namespace face::model {

// How a face's skin lies on a map: its own uvs, or for a mesh without any its height and angle about the head's upright
// axis. Only parts named "face" (all where there are none).
struct SkinAtlas {
  std::vector<render::Triangle> triangles;  // vertices
  std::vector<render::Triangle> corners;    // of the same triangles, into uvs
  std::vector<Vec2f> uvs;
};
SkinAtlas make_skin_atlas(const Mesh& mesh);

// Corners into the atlas's uvs of a triangulation's triangles, whatever their part.
std::vector<render::Triangle> uv_corners(const Mesh& mesh, const render::Triangulation& triangulation);

// Which triangle of the atlas every texel of a map shows; -1 = none. Row 0 is the top (v = 1).
struct TexelMap {
  render::Raster raster;
  std::vector<render::ScreenPoint> corners;  // uvs in texels

  Vec3f weights_at(const SkinAtlas& atlas, int x, int y) const;
};
TexelMap map_texels(const SkinAtlas& atlas, int width, int height);

}  // namespace face::model
