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
constexpr std::array<double, 11> kWhiteAngles = {28.0, 29.2, 33, 38, 44, 52, 62, 75, 92, 120, 155};
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
      head.add_vertex(kEyeCentre + radius * d, iris ? iris_color(angles[r], c)
                                               : angles[r] < 28.5
                                                   ? kLimbus
                                                   : lerp(kWhite, kWhiteFar, smooth_step(32, 66, angles[r])));
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

}  // namespace face::phantom
