// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/types/mesh.h"

namespace face::meshik {

// The polygons as fans of triangles, 3 corners each. Throws where a corner is out of range.
std::vector<std::uint32_t> fan_triangles(const Mesh& mesh);

// x, y, z of every vertex, one after the other.
std::vector<double> coordinates(const std::vector<Vec3f>& points_mm);

// The other way round.
std::vector<Vec3f> points_of(const std::vector<double>& coordinates_mm);

}  // namespace face::meshik
