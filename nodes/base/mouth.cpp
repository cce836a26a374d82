// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/mouth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "nodes/base/check.h"

namespace face {
namespace {

Vec3f minus(const Vec3f& a, const Vec3f& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
float dot(const Vec3f& a, const Vec3f& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec3f cross(const Vec3f& a, const Vec3f& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec3f along(const Vec3f& a, const Vec3f& b, float t) { return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]}; }
Vec3f unit(const Vec3f& a) {
  const float length = std::sqrt(dot(a, a));
  return length > 0 ? Vec3f{a[0] / length, a[1] / length, a[2] / length} : Vec3f{0, 0, 1};
}

// Barycentric coordinates of the point of a triangle nearest to p (Ericson, Real-Time Collision Detection, 2005,
// 5.1.5).
std::array<float, 3> nearest_in_triangle(const Vec3f& p, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
  const float d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3f bp = minus(p, b);
  const float d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const Vec3f cp = minus(p, c);
  const float d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const float w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const float sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

// Offset of a vertex under a shape; zero where the shape leaves it alone.
Vec3f offset_of(const Shape& shape, std::uint32_t vertex) {
  const auto found = std::lower_bound(shape.vertices.begin(), shape.vertices.end(), vertex);
  if (found == shape.vertices.end() || *found != vertex) return {0, 0, 0};
  return shape.offsets_mm[static_cast<std::size_t>(found - shape.vertices.begin())];
}

}  // namespace

LipGap lip_gap(const Rig& rig, const std::vector<Vec3f>& posed_mm) {
  const std::vector<Vec3f>& neutral = rig.neutral.points_mm;
  check(posed_mm.size() == neutral.size(), "the pose has ", posed_mm.size(), " vertices, the rig has ", neutral.size());
  check(!rig.inner_lips.empty(), "the rig names no inner lip pairs, so its lip gap cannot be measured");
  LipGap gap;
  gap.min_mm = std::numeric_limits<double>::infinity();
  gap.max_mm = -gap.min_mm;
  for (const LipPair& pair : rig.inner_lips) {
    check(pair.upper < neutral.size() && pair.lower < neutral.size(), "the lip pair ", pair.upper, ", ", pair.lower,
          " is outside the rig's ", neutral.size(), " vertices");
    const double posed = double{posed_mm[pair.upper][1]} - posed_mm[pair.lower][1];
    const double closed = double{neutral[pair.upper][1]} - neutral[pair.lower][1];
    gap.mean_mm += (posed - closed) / static_cast<double>(rig.inner_lips.size());
    gap.min_mm = std::min(gap.min_mm, posed - closed);
    gap.max_mm = std::max(gap.max_mm, posed - closed);
  }
  return gap;
}

double lip_gap_mm(const Rig& rig, const std::vector<Vec3f>& posed_mm) { return lip_gap(rig, posed_mm).mean_mm; }

std::vector<std::vector<double>> lip_gap_rows(const Rig& rig) {
  std::vector<std::vector<double>> rows;
  for (const LipPair& pair : rig.inner_lips) {
    std::vector<double>& row = rows.emplace_back();
    for (const Shape& shape : rig.shapes)
      row.push_back(double{offset_of(shape, pair.upper)[1]} - offset_of(shape, pair.lower)[1]);
  }
  return rows;
}

LipTeeth::LipTeeth(const Rig& rig) {
  const Mesh& mesh = rig.neutral;
  const auto checked = [&](std::uint32_t vertex, const char* list) {
    check(vertex < mesh.points_mm.size(), "vertex ", vertex, " of the rig's ", list, " is outside its ",
          mesh.points_mm.size(), " vertices");
    return vertex;
  };
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> tooth_of(mesh.points_mm.size(), none);
  for (const std::uint32_t vertex : rig.upper_teeth) {
    tooth_of[checked(vertex, "upper teeth")] = static_cast<std::uint32_t>(teeth_mm_.size());
    teeth_mm_.push_back(mesh.points_mm[vertex]);
  }
  if (!teeth_mm_.empty()) teeth_low_mm_ = teeth_high_mm_ = teeth_mm_.front();
  for (const Vec3f& tooth : teeth_mm_)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      teeth_low_mm_[axis] = std::min(teeth_low_mm_[axis], tooth[axis]);
      teeth_high_mm_[axis] = std::max(teeth_high_mm_[axis], tooth[axis]);
    }
  teeth_normals_.assign(teeth_mm_.size(), {0, 0, 0});
  vertex_triangles_.resize(teeth_mm_.size());
  for (std::size_t polygon = 0; polygon < mesh.polygon_count(); ++polygon) {
    const std::uint32_t first = mesh.polygon_starts[polygon];
    for (std::uint32_t corner = first + 1; corner + 1 < mesh.polygon_starts[polygon + 1]; ++corner) {
      const std::array<std::uint32_t, 3> triangle = {tooth_of[mesh.corners[first]], tooth_of[mesh.corners[corner]],
                                                     tooth_of[mesh.corners[corner + 1]]};
      if (std::find(triangle.begin(), triangle.end(), none) != triangle.end()) continue;
      // Length of the cross product = twice the area: normals are weighted by area.
      const Vec3f normal = cross(minus(teeth_mm_[triangle[1]], teeth_mm_[triangle[0]]),
                                 minus(teeth_mm_[triangle[2]], teeth_mm_[triangle[0]]));
      for (const std::uint32_t vertex : triangle) {
        teeth_normals_[vertex] = along(teeth_normals_[vertex], normal, 1);
        vertex_triangles_[vertex].push_back(static_cast<std::uint32_t>(triangles_.size()));
      }
      triangles_.push_back(triangle);
    }
  }
  for (Vec3f& normal : teeth_normals_) normal = unit(normal);
  // An edge that only one triangle has ends the surface.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& triangle : triangles_)
    for (std::size_t k = 0; k < 3; ++k) ++uses[std::minmax(triangle[k], triangle[(k + 1) % 3])];
  on_border_.assign(teeth_mm_.size(), false);
  for (const auto& [edge, count] : uses)
    if (count == 1) on_border_[edge.first] = on_border_[edge.second] = true;

  for (const std::uint32_t vertex : rig.lower_lip)
    lip_neutral_mm_.push_back(mesh.points_mm[checked(vertex, "lower lip")]);
  for (const Shape& shape : rig.shapes) {
    std::vector<Offset>& offsets = shape_offsets_.emplace_back();
    for (std::size_t i = 0; i < rig.lower_lip.size(); ++i) {
      const Vec3f offset = offset_of(shape, rig.lower_lip[i]);
      if (offset != Vec3f{0, 0, 0}) offsets.push_back({static_cast<std::uint32_t>(i), offset});
    }
  }
}

LipTeethContact LipTeeth::contact_of(std::size_t lip, const Vec3f& point_mm) const {
  std::size_t nearest = 0;
  float best = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < teeth_mm_.size(); ++i) {
    const Vec3f difference = minus(point_mm, teeth_mm_[i]);
    const float squared = dot(difference, difference);
    if (squared < best) best = squared, nearest = i;
  }
  Vec3f foot = teeth_mm_[nearest];
  Vec3f outward = teeth_normals_[nearest];
  bool border = on_border_[nearest];
  for (const std::uint32_t index : vertex_triangles_[nearest]) {
    const auto& t = triangles_[index];
    const auto b = nearest_in_triangle(point_mm, teeth_mm_[t[0]], teeth_mm_[t[1]], teeth_mm_[t[2]]);
    Vec3f point = {0, 0, 0}, normal = {0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      point = along(point, teeth_mm_[t[k]], b[k]);
      normal = along(normal, teeth_normals_[t[k]], b[k]);
    }
    const Vec3f difference = minus(point_mm, point);
    const float squared = dot(difference, difference);
    if (squared >= best) continue;
    best = squared, foot = point, outward = normal, border = true;
    for (std::size_t k = 0; k < 3; ++k)
      if (b[k] > 0 && !on_border_[t[k]]) border = false;
  }
  const Vec3f difference = minus(point_mm, foot);
  // Past the border of a surface that is not closed there is no inside.
  const bool inside = !border && dot(difference, outward) < 0;
  const float length = std::sqrt(dot(difference, difference));
  LipTeethContact contact;
  contact.lip = lip;
  contact.distance_mm = inside ? -length : length;
  // On the surface itself the direction to the foot is noise.
  contact.normal = length < 1e-3f ? unit(outward) : unit(inside ? minus(foot, point_mm) : difference);
  return contact;
}

std::vector<Vec3f> LipTeeth::posed_lip(const std::vector<float>& weights) const {
  check(usable(), "the rig names no lower lip or no upper teeth, so their distance cannot be measured");
  check(weights.size() <= shape_offsets_.size(), "there are ", weights.size(), " weights, but the rig has ",
        shape_offsets_.size(), " shapes");
  std::vector<Vec3f> points = lip_neutral_mm_;
  for (std::size_t s = 0; s < weights.size(); ++s)
    if (weights[s] != 0)
      for (const Offset& offset : shape_offsets_[s])
        points[offset.lip] = along(points[offset.lip], offset.offset_mm, weights[s]);
  return points;
}

std::vector<LipTeethContact> LipTeeth::contacts(const std::vector<float>& weights) const {
  const std::vector<Vec3f> points = posed_lip(weights);
  std::vector<LipTeethContact> contacts;
  for (std::size_t i = 0; i < points.size(); ++i) contacts.push_back(contact_of(i, points[i]));
  return contacts;
}

double LipTeeth::depth_mm(const std::vector<float>& weights) const {
  const std::vector<Vec3f> points = posed_lip(weights);
  double depth_mm = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool in_box = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      in_box = in_box && points[i][axis] > teeth_low_mm_[axis] && points[i][axis] < teeth_high_mm_[axis];
    if (in_box) depth_mm = std::max(depth_mm, -contact_of(i, points[i]).distance_mm);
  }
  return depth_mm;
}

LipTeethContact LipTeeth::nearest(const std::vector<float>& weights) const {
  const std::vector<LipTeethContact> all = contacts(weights);
  return *std::min_element(all.begin(), all.end(),
                           [](const auto& a, const auto& b) { return a.distance_mm < b.distance_mm; });
}

std::vector<double> LipTeeth::row(const LipTeethContact& contact) const {
  std::vector<double> row(shape_offsets_.size(), 0.0);
  for (std::size_t s = 0; s < row.size(); ++s)
    for (const Offset& offset : shape_offsets_[s])
      if (offset.lip == contact.lip) row[s] = dot(contact.normal, offset.offset_mm);
  return row;
}

}  // namespace face
