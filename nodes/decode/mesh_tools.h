// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>
#include <vector>

#include "nodes/types/mesh.h"

namespace face::decode {

// Small vector arithmetic on value types.
inline Vec3f minus(const Vec3f& a, const Vec3f& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline float dot(const Vec3f& a, const Vec3f& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
float length(const Vec3f& a);
inline float distance(const Vec3f& a, const Vec3f& b) { return length(minus(a, b)); }

// Distance of p to the segment from a to b.
float distance_to_segment(const Vec3f& p, const Vec3f& a, const Vec3f& b);

// Area-weighted vertex normals of unit length (0 where a vertex has no polygon). V x 3.
std::vector<Vec3f> vertex_normals(const Mesh& mesh);

// Label of the connected piece that each vertex belongs to: the smallest vertex of the piece. V.
std::vector<std::uint32_t> connected_pieces(const Mesh& mesh);

// Whether a vertex is in a part whose name contains the text. V.
std::vector<bool> vertices_of_parts(const Mesh& mesh, std::string_view text);

}  // namespace face::decode
