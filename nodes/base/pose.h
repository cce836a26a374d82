// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/rig.h"
#include "nodes/types/weights.h"

namespace face {

// Vertex positions of a rig at given weights: neutral + sum_s weight_s * shape_s.
// weights may be shorter than the rig's shapes (the rest is 0), never longer. Returns V x 3, mm.
std::vector<Vec3f> pose_points(const Rig& rig, const Weights& weights);

// Adds weight * shape to points (V x 3, mm).
void add_shape(const Shape& shape, float weight, std::vector<Vec3f>& points);

}  // namespace face
