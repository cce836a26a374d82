// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/pose.h"

#include "nodes/base/check.h"

namespace face {

void add_shape(const Shape& shape, float weight, std::vector<Vec3f>& points) {
  if (weight == 0) return;
  for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
    Vec3f& point = points[shape.vertices[i]];
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] += weight * shape.offsets_mm[i][axis];
  }
}

std::vector<Vec3f> pose_points(const Rig& rig, const Weights& weights) {
  check(weights.values.size() <= rig.shapes.size(), "there are ", weights.values.size(), " weights, but the rig has ",
        rig.shapes.size(), " shapes");
  std::vector<Vec3f> points = rig.neutral.points_mm;
  for (std::size_t s = 0; s < weights.values.size(); ++s) add_shape(rig.shapes[s], weights.values[s], points);
  return points;
}

}  // namespace face
