// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/line_mouth.h"

#include <algorithm>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/transfer/lip_sides.h"

namespace face::transfer {

Rig line_mouth(const Rig& rig, const Mesh& mesh, const LineMouthOptions& options) {
  check(rig.neutral.points_mm.size() == mesh.points_mm.size(), "rig has ", rig.neutral.points_mm.size(),
        " vertices, the mesh ", mesh.points_mm.size());
  const MouthOpening mouth = find_mouth_opening(mesh);
  Rig lined = rig;
  if (!mouth.found()) return lined;
  const auto x_of = [&](std::uint32_t v) { return mesh.points_mm[v][0]; };
  // Both edges from corner to corner.
  const auto chain = [&](std::vector<std::uint32_t> lip) {
    std::erase_if(lip, [&](std::uint32_t v) { return v == mouth.right_corner || v == mouth.left_corner; });
    std::stable_sort(lip.begin(), lip.end(), [&](std::uint32_t a, std::uint32_t b) { return x_of(a) < x_of(b); });
    lip.insert(lip.begin(), mouth.right_corner);
    lip.push_back(mouth.left_corner);
    return lip;
  };
  const std::vector<std::uint32_t> upper = chain(mouth.upper), lower = chain(mouth.lower);
  Mesh& out = lined.neutral;
  const auto first = static_cast<std::uint32_t>(out.polygon_count());
  const auto span = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a == b || b == c || a == c) return;
    for (const std::uint32_t v : {a, b, c}) {
      out.corners.push_back(v);
      if (!out.corner_uvs.empty()) out.corner_uvs.push_back(v);
    }
    out.polygon_starts.push_back(static_cast<std::uint32_t>(out.corners.size()));
  };
  std::size_t i = 0, j = 0;
  while (i + 1 < upper.size() || j + 1 < lower.size()) {
    const bool above = j + 1 == lower.size() || (i + 1 < upper.size() && x_of(upper[i + 1]) <= x_of(lower[j + 1]));
    if (above) {
      span(upper[i], lower[j], upper[i + 1]);
      ++i;
    } else {
      span(lower[j], lower[j + 1], upper[i]);
      ++j;
    }
  }
  const auto dark = static_cast<float>(options.brightness);
  out.parts.push_back(
      {"mouth", first, static_cast<std::uint32_t>(out.polygon_count()) - first, {dark, dark, dark}, 0, true});
  return lined;
}

}  // namespace face::transfer
