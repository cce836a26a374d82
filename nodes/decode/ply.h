// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/types/vec.h"

namespace face::decode {

// What a PLY file says of a mesh, in its own order and unit.
struct Ply {
  std::vector<Vec3f> points;                  // V
  std::vector<Vec3f> colors_srgb;             // V or empty, [0, 1]
  std::vector<std::uint32_t> corners;         // vertex of every polygon corner
  std::vector<std::uint32_t> polygon_starts;  // F + 1
};

// Reads PLY 1.0 (Turk, The PLY Polygon File Format, 1994): ascii, binary_little_endian and binary_big_endian. Of the
// element vertex x, y, z and red, green, blue; of the element face the list vertex_indices (or vertex_index). Other
// properties and elements are skipped. The vertex order is the file's. name: what messages call the file. Throws with
// name, line or byte, found and expected.
Ply read_ply(std::string_view bytes, const std::string& name);

}  // namespace face::decode
