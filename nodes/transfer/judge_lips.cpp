// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/judge_lips.h"

#include <algorithm>
#include <cstdlib>

#include "nodes/base/check.h"
#include "nodes/render/triangulate.h"
#include "nodes/transfer/lip_sides.h"

namespace face::transfer {

Table judge_lips(const SurfaceMap& places, const SurfaceMap& truth, const Rig& head, const JudgeLipsOptions& options) {
  const std::size_t count = truth.triangle.size();
  check(places.triangle.size() == count && truth.weights.size() == count && places.weights.size() == count,
        "places has ", places.triangle.size(), " triangles, truth ", count);
  const std::vector<render::Triangle> triangles = render::triangulate(head.neutral, false).triangles;
  const std::vector<LipSide> sides =
      head_sides(head.neutral, head.inner_lips, head.landmarks68, static_cast<float>(options.reach_mm));
  // The side that the corners agree on; none where they do not, or have none.
  const auto side_at = [&](const SurfaceMap& map, std::size_t v) {
    if (map.triangle[v] < 0) return LipSide::none;
    const auto t = static_cast<std::size_t>(map.triangle[v]);
    check(t < triangles.size(), "vertex ", v, " lies in triangle ", t, ", the head has ", triangles.size());
    int sum = 0;
    for (const std::uint32_t corner : triangles[t]) sum += static_cast<int>(sides[corner]);
    return std::abs(sum) == 3 ? static_cast<LipSide>(sum / 3) : LipSide::none;
  };
  double vertices = 0, wrong = 0, lost = 0;
  for (std::size_t v = 0; v < count; ++v) {
    const LipSide right = side_at(truth, v), found = side_at(places, v);
    if (right == LipSide::none) continue;
    ++vertices;
    wrong += found != LipSide::none && found != right ? 1 : 0;
    lost += places.triangle[v] < 0 ? 1 : 0;
  }
  return {{"vertices", "wrong", "lost"}, {{"all", {vertices, wrong, lost}}}};
}

}  // namespace face::transfer
