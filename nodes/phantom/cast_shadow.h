// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/render/rasterize.h"

namespace face::phantom {

// The share of a lamp's disc that every vertex of a mesh sees past the rest of it, in [0, 1] (V). The lamp is far away;
// shadows have an edge of about 2 * softness_mm. By a depth picture from the lamp (Williams, Casting Curved Shadows on
// Curved Surfaces, SIGGRAPH 1978), sampled on a disc (Reeves, Salesin, Cook: Rendering Antialiased Shadows with Depth
// Maps, SIGGRAPH 1987). Differs from the papers: found at vertices, the samples are fixed.
// points_mm, normals: V x 3. towards_light: unit.
std::vector<float> cast_shadow(const std::vector<Vec3f>& points_mm, const std::vector<Vec3f>& normals,
                               const std::vector<render::Triangle>& triangles, const Vec3f& towards_light,
                               float softness_mm);

}  // namespace face::phantom
