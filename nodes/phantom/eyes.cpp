// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/eyes.h"

#include <array>
#include <numbers>

#include "nodes/phantom/eyelids.h"

namespace face::phantom {
namespace {

// Angles from the line of sight: pupil, iris and the border to the white, in degrees. The pairs close together keep the
// colours' borders crisp, as colours live on vertices.
constexpr std::array<double, 9> kIrisAngles = {0, 6, 11.6, 12.4, 15, 19, 23.5, 26.8, 28.0};
constexpr std::array<double, 14> kWhiteAngles = {28.0, 29.2, 32, 35, 40, 46, 52, 60, 70, 82, 96, 115, 140, 165};
constexpr std::uint32_t kSegments = 32;

constexpr Vector3 kPupil = {0.015, 0.012, 0.012};
constexpr Vector3 kIrisInner = {0.46, 0.34, 0.16};
constexpr Vector3 kIrisOuter = {0.16, 0.36, 0.38};
constexpr Vector3 kLimbus = {0.05, 0.10, 0.12};
constexpr Vector3 kWhite = {0.95, 0.94, 0.93};
constexpr Vector3 kWhiteFar = {0.90, 0.78, 0.75};

Vector3 iris_color(double angle_deg, std::uint32_t segment) {
  if (angle_deg < 12) return kPupil;
  if (angle_deg > 26) return kLimbus;
  const double streak = 1 + 0.10 * std::cos(5 * segment * 2.0) + 0.06 * std::cos(3 * segment * 1.3 + 1);
  return lerp(kIrisInner, kIrisOuter, smooth_step(11, 18, angle_deg)) * streak;
}

// Surface of revolution about the line of sight; the cornea bulges over the iris.
void add_rings(HeadBuilder& head, const double* angles, std::size_t count, bool iris) {
  const std::uint32_t first = head.vertex_count();
  const std::uint32_t rows = static_cast<std::uint32_t>(count);
  for (std::uint32_t r = 0; r < rows; ++r) {
    const double a = angles[r] * std::numbers::pi / 180;
    const double radius = kEyeRadius + 0.3 * square(std::max(0.0, 1 - angles[r] / 30));
    const bool pole = angles[r] == 0;
    for (std::uint32_t c = 0; c < (pole ? 1 : kSegments); ++c) {
      const double turn = 2 * std::numbers::pi * c / kSegments;
      const Vector3 d = {std::sin(a) * std::cos(turn), std::sin(a) * std::sin(turn), std::cos(a)};
      head.add_vertex(kEyeCentre + radius * d,
                      iris ? iris_color(angles[r], c)
                           : angles[r] < 28.5 ? kLimbus : lerp(kWhite, kWhiteFar, smooth_step(32, 66, angles[r])));
    }
  }
  std::uint32_t row = first;
  for (std::uint32_t r = 0; r + 1 < rows; ++r) {
    const bool pole = angles[r] == 0;
    const std::uint32_t next = row + (pole ? 1 : kSegments);
    for (std::uint32_t c = 0; c < kSegments; ++c) {
      const std::uint32_t d = (c + 1) % kSegments;
      head.add_polygon({pole ? row : row + c, next + c, next + d, pole ? row : row + d});
    }
    row = next;
  }
}

}  // namespace

Eyes add_eyes(HeadBuilder& head) {
  Eyes eyes;
  eyes.left.first = head.vertex_count();
  const auto polygons = [&] { return static_cast<std::uint32_t>(head.polygon_starts.size() - 1); };
  const std::uint32_t white_vertex = head.vertex_count(), white_polygon = polygons();
  head.begin_part("sclera_left", {1, 1, 1}, 0.9);
  add_rings(head, kWhiteAngles.data(), kWhiteAngles.size(), false);
  head.begin_part("iris_left", {1, 1, 1}, 0.95);
  add_rings(head, kIrisAngles.data(), kIrisAngles.size(), true);
  eyes.left.end = eyes.right.first = head.vertex_count();
  // The whole eye is copied as one; the copy is then split where the original is.
  const std::uint32_t left_end = polygons();
  head.add_mirror_image("sclera_right", white_vertex, white_polygon);
  eyes.right.end = head.vertex_count();
  Part iris = head.parts.back();
  const std::uint32_t whites = head.parts[head.parts.size() - 3].polygon_count;
  head.parts.back().polygon_count = whites;
  iris.name = "iris_right";
  iris.first_polygon = left_end + whites;
  iris.polygon_count -= whites;
  head.parts.push_back(iris);
  return eyes;
}

void mirror_anchors(const HeadBuilder& head, Attached& attached) {
  const std::size_t count = attached.anchors.size();
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<Anchor> anchors = attached.anchors[k];
    for (Anchor& anchor : anchors) anchor.vertex = head.mirror[anchor.vertex];
    attached.anchors.push_back(anchors);
  }
}

Attached add_lashes(HeadBuilder& head, const Skin& skin) {
  Attached lashes;
  lashes.range.first = head.vertex_count();
  const auto polygons = static_cast<std::uint32_t>(head.polygon_starts.size() - 1);
  head.begin_part("lashes", {0.13, 0.09, 0.08}, 0.1);
  constexpr int kFirst = 0, kLast = 23;
  for (int c = kFirst; c <= kLast; ++c) {
    const double s = lid_position(c), full = std::sqrt(std::max(0.0, 1 - square((s - 0.25) / 1.28)));
    const Vector3 edge = lid_point(-1, c), front = lid_point(0, c);
    const Vector3 out = unit(Vector3{0.55 * s, 0.42, 0.75});
    const Vector3 tip = front + (2.9 * full * smooth_step(-0.9, 0.6, s) + 0.35) * out +
                        Vector3{0, 0.8 * full * full, 0};
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
