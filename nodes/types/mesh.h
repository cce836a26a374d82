// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/types/vec.h"

namespace face {

// A run of polygons that share a material: "face", "head", "mouth_socket", "gums", "tongue", "teeth", "sclera_left",
// "iris_left", "eye_fluid", "lashes", "brows", ...
struct Part {
  std::string name;
  std::uint32_t first_polygon = 0;
  std::uint32_t polygon_count = 0;
  Vec3f albedo_srgb = {0.8f, 0.8f, 0.8f};  // multiplied with the vertex colour where there is one
  float gloss = 0;                         // 0 matt to 1 wet
  bool visible = true;  // false for helper geometry (eye occlusion shells) that a plain renderer skips
};

// A polygon mesh: mm, right-handed, y up, z to the viewer; polygons run counter-clockwise seen from outside.
struct Mesh {
  std::vector<Vec3f> points_mm;               // V
  std::vector<std::uint32_t> corners;         // vertex of every polygon corner, polygon after polygon
  std::vector<std::uint32_t> polygon_starts;  // F + 1 offsets into corners
  std::vector<Vec2f> uvs;                     // origin bottom left; may be empty
  std::vector<std::uint32_t> corner_uvs;      // uv of every corner; empty or as long as corners
  std::vector<Vec3f> colors_srgb;             // V or empty, each in [0, 1]
  std::vector<Part> parts;                    // tile the polygons in order; may be empty

  std::size_t polygon_count() const { return polygon_starts.empty() ? 0 : polygon_starts.size() - 1; }
};

}  // namespace face
