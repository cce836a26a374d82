// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/carry_fine.h"

#include "nodes/base/check.h"
#include "nodes/meshik/factor_space.h"
#include "nodes/meshik/reconstruct.h"

namespace face::meshik {

MeshPoints carry_fine(const MeshSpace& space, const MeshSpace& simple_space, const Matrix& binding,
                      const Weights& weights, const MeshPoints& points) {
  check_space(space);
  check_space(simple_space);
  check(space.example_count == simple_space.example_count, "the whole head has ", space.example_count,
        " examples, the simplified one ", simple_space.example_count);
  if (weights.values.empty() && points.points_mm.empty()) return {};
  check(points.points_mm.size() == simple_space.vertex_count, "there are ", points.points_mm.size(),
        " points, the simplified head has ", simple_space.vertex_count, " vertices");
  check(binding.rows == space.vertex_count && binding.columns == 6 && binding.values.size() == 6 * binding.rows,
        "binding is ", binding.rows, " x ", binding.columns, ", expected ", space.vertex_count, " x 6");
  const MeshPoints simple = reconstruct(simple_space, weights);
  MeshPoints fine = reconstruct(space, weights);
  for (std::size_t v = 0; v < fine.points_mm.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c) {
      const double share = binding.at(v, 3 + c), number = binding.at(v, c);
      if (share == 0) continue;
      check(number >= 0 && number < static_cast<double>(simple.points_mm.size()), "vertex ", v, " is bound to vertex ",
            number, ", the simplified head has ", simple.points_mm.size());
      const auto from = static_cast<std::size_t>(number);
      for (std::size_t d = 0; d < 3; ++d)
        fine.points_mm[v][d] += static_cast<float>(share) * (points.points_mm[from][d] - simple.points_mm[from][d]);
    }
  return fine;
}

}  // namespace face::meshik
