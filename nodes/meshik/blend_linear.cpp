// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/blend_linear.h"

#include "nodes/base/check.h"

namespace face::meshik {

MeshPoints blend_linear(const Mesh& reference, const engine::Seq<Mesh>& examples, const Weights& weights) {
  check(weights.values.size() <= examples.size(), "there are ", weights.values.size(), " weights, expected at most ",
        examples.size(), ", one per example");
  MeshPoints blend{reference.points_mm};
  for (std::size_t k = 0; k < weights.values.size(); ++k) {
    const auto example = examples.at(k);
    check(example->points_mm.size() == blend.points_mm.size(), "example ", examples.id(k), " has ",
          example->points_mm.size(), " vertices, expected ", blend.points_mm.size());
    for (std::size_t v = 0; v < blend.points_mm.size(); ++v)
      for (std::size_t d = 0; d < 3; ++d)
        blend.points_mm[v][d] += weights.values[k] * (example->points_mm[v][d] - reference.points_mm[v][d]);
  }
  return blend;
}

}  // namespace face::meshik
