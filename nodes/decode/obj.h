// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/types/vec.h"

namespace face::decode {

// The polygons that follow one usemtl line.
struct ObjMaterial {
  std::string name;
  std::uint32_t first_polygon = 0;
};

// What an OBJ file says, in its own order and unit.
struct Obj {
  std::vector<Vec3f> points;                  // V
  std::vector<Vec2f> uvs;                     // may be empty
  std::vector<std::uint32_t> corners;         // vertex of every polygon corner
  std::vector<std::uint32_t> corner_uvs;      // as long as corners, or empty where some corner has no uv
  std::vector<std::uint32_t> polygon_starts;  // F + 1
  std::vector<ObjMaterial> materials;         // by first polygon
};

// Reads v, vt, f and usemtl lines (Wavefront, Advanced Visualizer manual, appendix B1: Object Files); others are
// skipped. Written here because blend shapes need the file's own vertex order: OpenMesh splits and drops non-manifold
// vertices and reads streams, which is too slow for a rig of 54 files. name: what messages call the file. Throws on
// malformed numbers and indices out of range, with line, found and expected.
Obj read_obj(std::string_view text, const std::string& name);

}  // namespace face::decode
