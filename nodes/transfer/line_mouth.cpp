// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/line_mouth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/transfer/lip_sides.h"

namespace face::transfer {
namespace {

using Chain = std::vector<std::uint32_t>;

// The point of a chain's line above or below a point; where the chain ends before, its end.
Vec3f facing(const Chain& chain, const std::vector<Vec3f>& points_mm, float x_mm) {
  std::size_t i = 0;
  while (i + 2 < chain.size() && points_mm[chain[i + 1]][0] < x_mm) ++i;
  const Vec3f &a = points_mm[chain[i]], &b = points_mm[chain[i + 1]];
  const float wide = b[0] - a[0], share = wide > 0 ? std::clamp((x_mm - a[0]) / wide, 0.0f, 1.0f) : 0;
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}

// Adds a vertex that has another's colour, place in the picture and motion, and is where it is told.
std::uint32_t add_vertex(Rig& rig, std::uint32_t like, const Vec3f& point_mm) {
  Mesh& mesh = rig.neutral;
  const auto added = static_cast<std::uint32_t>(mesh.points_mm.size());
  mesh.points_mm.push_back(point_mm);
  if (!mesh.colors_srgb.empty()) mesh.colors_srgb.push_back(Vec3f(mesh.colors_srgb[like]));
  if (!mesh.corner_uvs.empty()) mesh.uvs.push_back(Vec2f(mesh.uvs[like]));
  for (Shape& shape : rig.shapes) {
    const auto at = std::lower_bound(shape.vertices.begin(), shape.vertices.end(), like);
    if (at == shape.vertices.end() || *at != like) continue;
    const Vec3f offset = shape.offsets_mm[static_cast<std::size_t>(at - shape.vertices.begin())];
    shape.vertices.push_back(added);
    shape.offsets_mm.push_back(offset);
  }
  return added;
}

// The edge of one lip's rim: a vertex for every one of the lip's, halfway to the other lip. The corners are their own.
Chain rim_of(Rig& rig, const Chain& lip, const Chain& other, const std::vector<Vec3f>& points_mm, float rim_mm) {
  Chain rim = lip;
  for (std::size_t i = 1; i + 1 < lip.size(); ++i) {
    const Vec3f from = points_mm[lip[i]], to = facing(other, points_mm, from[0]);
    const float gap = std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
    const float share = gap > 0 ? std::min(0.5f, rim_mm / gap) : 0;
    rim[i] = add_vertex(rig, lip[i],
                        {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]),
                         from[2] + share * (to[2] - from[2])});
  }
  return rim;
}

}  // namespace

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
  const Chain upper_lip = chain(mouth.upper), lower_lip = chain(mouth.lower);
  Mesh& out = lined.neutral;
  const auto span = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a == b || b == c || a == c) return;
    for (const std::uint32_t v : {a, b, c}) {
      out.corners.push_back(v);
      if (!out.corner_uvs.empty()) out.corner_uvs.push_back(v);
    }
    out.polygon_starts.push_back(static_cast<std::uint32_t>(out.corners.size()));
  };
  auto first = static_cast<std::uint32_t>(out.polygon_count());
  const auto end_part = [&](const char* name, float brightness) {
    out.parts.push_back({name,
                         first,
                         static_cast<std::uint32_t>(out.polygon_count()) - first,
                         {brightness, brightness, brightness},
                         0,
                         true});
    first = static_cast<std::uint32_t>(out.polygon_count());
  };
  Chain upper = upper_lip, lower = lower_lip;
  if (options.rim_mm > 0) {
    const std::vector<Vec3f> points_mm = out.points_mm;
    upper = rim_of(lined, upper_lip, lower_lip, points_mm, static_cast<float>(options.rim_mm));
    lower = rim_of(lined, lower_lip, upper_lip, points_mm, static_cast<float>(options.rim_mm));
    for (std::size_t i = 0; i + 1 < upper.size(); ++i) {
      span(upper_lip[i], upper[i], upper_lip[i + 1]);
      span(upper[i], upper[i + 1], upper_lip[i + 1]);
    }
    for (std::size_t i = 0; i + 1 < lower.size(); ++i) {
      span(lower_lip[i], lower_lip[i + 1], lower[i]);
      span(lower[i], lower_lip[i + 1], lower[i + 1]);
    }
    end_part("rims", 1);
  }
  std::size_t i = 0, j = 0;
  while (i + 1 < upper.size() || j + 1 < lower.size()) {
    const bool above =
        j + 1 == lower.size() || (i + 1 < upper.size() && x_of(upper_lip[i + 1]) <= x_of(lower_lip[j + 1]));
    if (above) {
      span(upper[i], lower[j], upper[i + 1]);
      ++i;
    } else {
      span(lower[j], lower[j + 1], upper[i]);
      ++j;
    }
  }
  end_part("mouth", static_cast<float>(options.brightness));
  return lined;
}

}  // namespace face::transfer
