// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/lashes.h"

#include "nodes/phantom/eyelids.h"

namespace face::phantom {

Attached add_lashes(HeadBuilder& head, const Skin& skin) {
  Attached lashes;
  lashes.range.first = head.vertex_count();
  const auto polygons = static_cast<std::uint32_t>(head.polygon_starts.size() - 1);
  head.begin_part("lashes", {0.13, 0.09, 0.08}, 0.1);
  constexpr int kFirst = 0, kLast = 24;
  for (int c = kFirst; c <= kLast; ++c) {
    const double s = lid_position(c), full = std::sqrt(std::max(0.0, 1 - square((s - 0.25) / 1.28)));
    const Vector3 edge = lid_point(-1, c), front = lid_point(0, c);
    const Vector3 out = unit(Vector3{0.55 * s, 0.42, 0.75});
    const Vector3 tip =
        front + (2.9 * full * smooth_step(-0.9, 0.6, s) + 0.35) * out + Vector3{0, 0.8 * full * full, 0};
    const Vector3 under = lerp(edge, front, 0.75);
    for (const Vector3& p : {front + Vector3{0, 0.35, 0.25}, tip, under + Vector3{0, -0.15, 0.35}}) {
      head.add_vertex(p, {1, 1, 1});
      lashes.anchors.push_back({{skin.left_eye(0, c), 1}});
    }
  }
  const std::uint32_t count = static_cast<std::uint32_t>(lashes.anchors.size());
  for (std::uint32_t r = 0; r + 3 < count; r += 3) {
    const std::uint32_t a = lashes.range.first + r, b = a + 3;
    head.add_polygon({a, a + 1, b + 1, b});
    head.add_polygon({a + 1, a + 2, b + 2, b + 1});
  }
  const Part left = head.parts.back();
  head.add_mirror_image("lashes", lashes.range.first, polygons);
  head.parts.pop_back();  // both sides are one part
  head.parts.back().polygon_count = 2 * left.polygon_count;
  mirror_anchors(head, lashes);
  lashes.range.end = head.vertex_count();
  return lashes;
}

}  // namespace face::phantom
