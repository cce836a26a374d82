// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/types/matrix.h"
#include "nodes/types/vec.h"

namespace face::meshik {

// Where every vertex lies on a coarser surface of some of the same vertices: V x 6, three of its vertices and their
// shares, which add up to 1 (Ericson, Real-Time Collision Detection, 2005, section 5.1.5: the closest point of a
// triangle). Only triangles of the vertex's own connected part of the fine surface count; where it has none, the
// vertices are the first one and the shares 0. A vertex of the coarse surface has a share of 1 in itself.
// points_mm: V. triangles, coarse: three vertices each.
Matrix bind_surface(const std::vector<Vec3f>& points_mm, const std::vector<std::uint32_t>& triangles,
                    const std::vector<std::uint32_t>& coarse);

}  // namespace face::meshik
