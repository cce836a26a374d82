// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/mean_shape.h"

#include <vector>

#include "nodes/base/check.h"

namespace face::model {

MeshPoints mean_shape(const engine::Seq<MeshPoints>& shapes) {
  check(!shapes.empty(), "shapes is empty, expected at least 1 element");
  const std::size_t vertices = shapes.at(0)->points_mm.size();
  std::vector<double> sum(3 * vertices, 0);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto shape = shapes.at(i);
    check(shape->points_mm.size() == vertices, "shape ", shapes.id(i), " has ", shape->points_mm.size(), " points, ",
          shapes.id(0), " has ", vertices);
    for (std::size_t v = 0; v < vertices; ++v)
      for (std::size_t k = 0; k < 3; ++k) sum[3 * v + k] += static_cast<double>(shape->points_mm[v][k]);
  }
  MeshPoints mean;
  for (std::size_t v = 0; v < vertices; ++v) {
    Vec3f p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = static_cast<float>(sum[3 * v + k] / static_cast<double>(shapes.size()));
    mean.points_mm.push_back(p);
  }
  return mean;
}

}  // namespace face::model
