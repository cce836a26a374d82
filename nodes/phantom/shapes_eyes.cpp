// SPDX-License-Identifier: Apache-2.0
// Eyelids, eyeballs and brows of the embedded head.
#include <numbers>

#include "nodes/base/check.h"
#include "nodes/phantom/eyelids.h"
#include "nodes/phantom/lashes.h"
#include "nodes/phantom/sculptor.h"

namespace face::phantom {
namespace {

// How far the lids are shut, as a share of the way to where they meet; negative opens them wider.
struct Lids {
  double upper = 0, lower = 0;
};

Vector3 outside_ball(Vector3 point, double clearance_mm) {
  const Vector3 d = point - kEyeCentre;
  const double r = kEyeRadius + clearance_mm, flat2 = r * r - d.x * d.x - d.y * d.y;
  if (flat2 > 0) point.z = std::max(point.z, kEyeCentre.z + std::sqrt(flat2));
  return point;
}

// Moves the left eye's lids. The lids slide over the ball; the rings outside follow less and less.
void move_lids(const Head& head, Lids lids, Offsets& offsets) {
  constexpr double kMeeting = 0.16;  // the lids meet this far up the opening
  const auto at = [&](int ring, int column) { return head.mesh.points_mm[head.skin.left_eye(ring, column)]; };
  for (int c = 0; c < kEyeColumns; ++c) {
    const int side = lid_side(c), other = (kEyeColumns - c) % kEyeColumns;
    if (side == 0) continue;
    const double upper_y = at(-1, side > 0 ? c : other).y, lower_y = at(-1, side > 0 ? other : c).y;
    const double meet_y = lerp(lower_y, upper_y, kMeeting);
    const double shut = side > 0 ? lids.upper : lids.lower;
    const double outer_y = at(kEyeOuterRing, c).y;
    for (int ring = kEyeDeepestRing; ring < kEyeOuterRing; ++ring) {
      const Vector3 from = at(ring, c);
      Vector3 to = from;
      const double edge_y = at(-1, c).y;
      const double moved_edge = lerp(edge_y, meet_y, shut);
      if (ring < 0) {
        to.y = from.y + moved_edge - edge_y;
      } else {
        // Shut lids also press their edges flat against each other.
        const double thin = lerp(1.0, 0.25, std::clamp(shut, 0.0, 1.0) * (ring == 0));
        const double share = (from.y - edge_y) / (outer_y - edge_y);
        to.y = ring == 0 ? moved_edge + (from.y - edge_y) * thin : lerp(moved_edge, outer_y, share);
      }
      const double clearance = ring < 0 ? 0.35 : ring == 0 ? 1.6 : 2.0;
      const double keeps = smooth_step(0.8, 5.5, ring);
      const Vector3 d = to - kEyeCentre, d0 = from - kEyeCentre;
      const double r = kEyeRadius + clearance;
      const auto ball = [&](double x, double y) { return std::sqrt(std::max(square(4.0), r * r - x * x - y * y)); };
      to.z = from.z + (1 - keeps) * (ball(d.x, d.y) - ball(d0.x, d0.y));
      to = outside_ball(to, clearance * (1 - 0.4 * keeps));
      if (ring >= 2 && std::abs(shut) < 1e-9) to = from;
      offsets[head.skin.left_eye(ring, c)] += to - from;
    }
  }
  // Lashes turn with the lid that they grow on: their tips come down.
  const std::uint32_t half = (head.lashes.range.end - head.lashes.range.first) / 2;
  for (std::uint32_t k = 1; k < half; k += kLashVertices) {
    const std::uint32_t v = head.lashes.range.first + k;
    const Vector3 root = head.mesh.points_mm[head.lashes.anchors[k].front().vertex], tip = head.mesh.points_mm[v];
    offsets[v] += Vector3{0, -1.5 * lids.upper * (tip.y - root.y), 0.1 * lids.upper * (tip.y - root.y)};
  }
}

// Turns the left eyeball: pitch up, yaw to the head's left, in degrees.
void turn_eye(const Head& head, double pitch_deg, double yaw_deg, Offsets& offsets) {
  const double p = pitch_deg * std::numbers::pi / 180, w = yaw_deg * std::numbers::pi / 180;
  for (std::uint32_t v = head.eyes.left.first; v < head.eyes.left.end; ++v) {
    const Vector3 d = head.mesh.points_mm[v] - kEyeCentre;
    const Vector3 a = {d.x, d.y * std::cos(p) + d.z * std::sin(p), d.z * std::cos(p) - d.y * std::sin(p)};
    const Vector3 b = {a.x * std::cos(w) + a.z * std::sin(w), a.y, a.z * std::cos(w) - a.x * std::sin(w)};
    offsets[v] += b - d;
  }
}

// Moves the skin about a place of the chart; radii in degrees. The lids themselves stay.
void push(const Head& head, ChartPoint centre, double azimuth_radius, double elevation_radius, Vector3 by,
          Offsets& offsets) {
  for (std::size_t v = 0; v < head.skin.vertices.size(); ++v) {
    const SkinVertex& vertex = head.skin.vertices[v];
    if (vertex.loop == SkinVertex::Loop::mouth) continue;
    double weight = bell(vertex.at.azimuth_deg - centre.azimuth_deg, azimuth_radius) *
                    bell(vertex.at.elevation_deg - centre.elevation_deg, elevation_radius);
    if (vertex.loop != SkinVertex::Loop::none) weight *= smooth_step(0.5, 5, vertex.ring);
    if (weight > 0.01) offsets[v] += smooth_step(0.01, 0.08, weight) * weight * by;
  }
}

}  // namespace

Offsets eye_shape(const Head& head, std::string_view name) {
  Offsets offsets(head.mesh.points_mm.size());
  if (name == "eyeBlinkLeft") {
    move_lids(head, {1, 1}, offsets);
  } else if (name == "eyeLookDownLeft") {
    turn_eye(head, -26, 0, offsets);
    move_lids(head, {0.52, -0.35}, offsets);
  } else if (name == "eyeLookUpLeft") {
    turn_eye(head, 24, 0, offsets);
    move_lids(head, {-0.20, 0.25}, offsets);
    push(head, {21, 30}, 12, 5, {0, 1.0, 0}, offsets);
  } else if (name == "eyeLookInLeft") {
    turn_eye(head, 0, -30, offsets);
  } else if (name == "eyeLookOutLeft") {
    turn_eye(head, 0, 32, offsets);
  } else if (name == "eyeSquintLeft") {
    move_lids(head, {0.22, 1.25}, offsets);
    push(head, {22, 9}, 11, 5, {0, 2.2, 0.8}, offsets);
    push(head, {38, 19}, 6, 7, {-0.4, 0, 0}, offsets);
  } else if (name == "eyeWideLeft") {
    move_lids(head, {-0.26, -0.5}, offsets);
    push(head, {21, 30}, 12, 5, {0, 1.2, 0}, offsets);
  } else {
    fail("'", name, "' is not a shape of the left eye");
  }
  return offsets;
}

Offsets brow_shape(const Head& head, std::string_view name) {
  Offsets offsets(head.mesh.points_mm.size());
  if (name == "browDownLeft") {
    push(head, {12, 31}, 8, 6.5, {-2.0, -5.8, 1.4}, offsets);
    push(head, {26, 33}, 9, 6.5, {-1.0, -4.2, 0.6}, offsets);
  } else if (name == "browInnerUp") {
    push(head, {10, 33}, 9.5, 8.5, {0.4, 6.2, 0.2}, offsets);
    push(head, {-10, 33}, 9.5, 8.5, {-0.4, 6.2, 0.2}, offsets);
    symmetrise(head, offsets);
  } else if (name == "browOuterUpLeft") {
    push(head, {28, 33}, 11, 8.5, {0.8, 7.4, -1.0}, offsets);
  } else {
    fail("'", name, "' is not a shape of the left brow");
  }
  return offsets;
}

}  // namespace face::phantom
