// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/regions.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "nodes/base/check.h"
#include "nodes/types/arkit.h"

namespace face::evaluate {
namespace {

constexpr float lip_margin_mm = 1, lip_depth_mm = 20, lid_margin_mm = 2, temple_depth_mm = 10;

bool has_landmarks(const Rig& rig) {
  if (rig.landmarks68.size() != 68) return false;
  for (const std::uint32_t v : rig.landmarks68)
    check(v < rig.neutral.points_mm.size(), "landmark vertex ", v, " is outside the rig's ",
          rig.neutral.points_mm.size(), " vertices");
  return true;
}

const Vec3f& landmark(const Rig& rig, std::size_t i) { return rig.neutral.points_mm[rig.landmarks68[i]]; }

bool in_polygon(const std::vector<Vec2f>& polygon, float x, float y) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2f &a = polygon[i], &b = polygon[j];
    if ((a[1] > y) != (b[1] > y) && x < (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) + a[0]) inside = !inside;
  }
  return inside;
}

float distance_to_outline(const std::vector<Vec2f>& polygon, float x, float y) {
  float least = 1e9f;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const float dx = polygon[i][0] - polygon[j][0], dy = polygon[i][1] - polygon[j][1];
    const float length = dx * dx + dy * dy;
    const float t =
        length > 0 ? std::clamp(((x - polygon[j][0]) * dx + (y - polygon[j][1]) * dy) / length, 0.0f, 1.0f) : 0;
    least = std::min(least, std::hypot(x - polygon[j][0] - t * dx, y - polygon[j][1] - t * dy));
  }
  return least;
}

struct Front {
  float lids_y = 0, temple_z = 0;
};

Front front_of(const Rig& rig) {
  const float lids = landmark(rig, 40)[1] + landmark(rig, 41)[1] + landmark(rig, 46)[1] + landmark(rig, 47)[1];
  return {lids / 4 - lid_margin_mm, std::min(landmark(rig, 17)[2], landmark(rig, 26)[2]) - temple_depth_mm};
}

}  // namespace

std::vector<std::uint32_t> skin_vertices(const Rig& rig) {
  const Mesh& mesh = rig.neutral;
  std::set<std::uint32_t> marks;
  if (has_landmarks(rig)) marks.insert(rig.landmarks68.begin(), rig.landmarks68.end());
  std::vector<std::uint8_t> in(mesh.points_mm.size(), 0);
  const auto corners_of = [&](std::size_t first, std::size_t count, auto visit) {
    for (std::size_t c = mesh.polygon_starts[first]; c < mesh.polygon_starts[first + count]; ++c)
      visit(mesh.corners[c]);
  };
  bool any = false;
  for (const Part& part : mesh.parts) {
    bool holds = false;
    corners_of(part.first_polygon, part.polygon_count, [&](std::uint32_t v) { holds = holds || marks.contains(v); });
    if (!holds) continue;
    any = true;
    corners_of(part.first_polygon, part.polygon_count, [&](std::uint32_t v) { in.at(v) = 1; });
  }
  if (!any && mesh.polygon_count() > 0) corners_of(0, mesh.polygon_count(), [&](std::uint32_t v) { in.at(v) = 1; });
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < in.size(); ++v)
    if (in[v]) vertices.push_back(v);
  return vertices;
}

std::vector<std::uint32_t> lip_vertices(const Rig& rig) {
  const std::vector<Vec3f>& points = rig.neutral.points_mm;
  std::set<std::uint32_t> lips;
  if (has_landmarks(rig)) {
    std::vector<Vec2f> outline;
    float front = -1e9f;
    for (std::size_t i = 48; i < 60; ++i) {
      outline.push_back({landmark(rig, i)[0], landmark(rig, i)[1]});
      front = std::max(front, landmark(rig, i)[2]);
      lips.insert(rig.landmarks68[i]);
    }
    for (const std::uint32_t v : skin_vertices(rig)) {
      const Vec3f& p = points[v];
      if (p[2] < front - lip_depth_mm) continue;
      if (in_polygon(outline, p[0], p[1]) || distance_to_outline(outline, p[0], p[1]) <= lip_margin_mm) lips.insert(v);
    }
  } else {
    for (const LipPair& pair : rig.inner_lips) lips.insert(pair.upper), lips.insert(pair.lower);
    lips.insert(rig.lower_lip.begin(), rig.lower_lip.end());
  }
  check(!lips.empty(),
        "the rig names neither 68 landmarks nor inner lip pairs, so its lips are not known: connect lips");
  check(*lips.rbegin() < points.size(), "lip vertex ", *lips.rbegin(), " is outside the rig's ", points.size(),
        " vertices");
  return {lips.begin(), lips.end()};
}

std::vector<std::uint32_t> upper_face_vertices(const Rig& rig) {
  check(has_landmarks(rig), "the rig has ", rig.landmarks68.size(),
        " landmarks, expected 68 to know its upper face by: connect upper_face");
  const Front front = front_of(rig);
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t v : skin_vertices(rig)) {
    const Vec3f& p = rig.neutral.points_mm[v];
    if (p[1] >= front.lids_y && p[2] >= front.temple_z) vertices.push_back(v);
  }
  return vertices;
}

std::vector<Region> face_regions(const Rig& rig) {
  const std::vector<std::uint32_t> skin = skin_vertices(rig);
  if (!has_landmarks(rig)) return {{"all", skin}};
  const std::vector<std::uint32_t> lips = lip_vertices(rig);
  const Front front = front_of(rig);
  const float mouth_y = std::max(landmark(rig, 50)[1], landmark(rig, 52)[1]);
  std::vector<Region> regions = {{"lips", lips},     {"upper_face", {}}, {"middle_face", {}},
                                 {"lower_face", {}}, {"rest", {}},       {"all", skin}};
  for (const std::uint32_t v : skin) {
    if (std::binary_search(lips.begin(), lips.end(), v)) continue;
    const Vec3f& p = rig.neutral.points_mm[v];
    const std::size_t place = p[2] < front.temple_z ? 4 : p[1] >= front.lids_y ? 1 : p[1] >= mouth_y ? 2 : 3;
    regions[place].vertices.push_back(v);
  }
  return regions;
}

std::vector<std::uint32_t> jaw_free_vertices(const Rig& rig) {
  constexpr float still_mm = 0.1f;
  std::set<std::uint32_t> moved;
  if (const std::size_t jaw = arkit_index("jawOpen"); jaw < rig.shapes.size()) {
    const Shape& shape = rig.shapes[jaw];
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
      const Vec3f& d = shape.offsets_mm.at(i);
      if (std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) >= still_mm) moved.insert(shape.vertices[i]);
    }
  }
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t v : skin_vertices(rig))
    if (!moved.contains(v)) vertices.push_back(v);
  return vertices;
}

std::vector<std::uint32_t> chosen_vertices(const VertexMask* mask, std::size_t vertex_count, const char* name,
                                           const std::vector<std::uint32_t>& otherwise) {
  std::vector<std::uint32_t> vertices = otherwise;
  if (mask) {
    check(mask->on.size() == vertex_count, name, " has ", mask->on.size(), " vertices, expected ", vertex_count);
    vertices.clear();
    for (std::uint32_t v = 0; v < mask->on.size(); ++v)
      if (mask->on[v]) vertices.push_back(v);
  }
  check(!vertices.empty(), name, " holds no vertex");
  return vertices;
}

}  // namespace face::evaluate
