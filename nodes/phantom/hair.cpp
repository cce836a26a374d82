// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/hair.h"

#include <array>
#include <numbers>

#include "nodes/phantom/head_surface.h"

namespace face::phantom {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Vector3 kHairDark = {0.20, 0.125, 0.085}, kHairLight = {0.50, 0.33, 0.21};

// Elevation of the hairline by azimuth, both in degrees.
constexpr std::array<std::array<double, 2>, 15> kHairline = {{{0, 51},
                                                              {14, 52},
                                                              {28, 51},
                                                              {40, 45},
                                                              {50, 35},
                                                              {60, 25},
                                                              {68, 18},
                                                              {75, 15},
                                                              {82, 20},
                                                              {92, 28},
                                                              {101, 24},
                                                              {110, 6},
                                                              {121, -8},
                                                              {140, -18},
                                                              {180, -26}}};

double hairline(double azimuth_deg) {
  const double a = std::abs(azimuth_deg);
  // The fringe falls to the head's left, from a parting on the right.
  const double fringe = -5.0 * bell(azimuth_deg - 24, 24) + 3.0 * bell(azimuth_deg + 30, 15);
  std::size_t i = 0;
  while (i + 2 < kHairline.size() && a > kHairline[i + 1][0]) ++i;
  const double t = (a - kHairline[i][0]) / (kHairline[i + 1][0] - kHairline[i][0]);
  return lerp(kHairline[i][1], kHairline[i + 1][1], t * t * (3 - 2 * t)) + fringe;
}

constexpr std::uint32_t kLocks = 27, kColumnsPerLock = 6, kHairColumns = kLocks * kColumnsPerLock, kHairRows = 17;
constexpr ChartPoint kWhorl = {-168, 64};
constexpr double kSwirl = 0.16;  // how much the locks turn about the whorl, radians per squared radian of distance

Vector3 direction(ChartPoint at) {
  const double a = at.azimuth_deg * kPi / 180, e = at.elevation_deg * kPi / 180;
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

ChartPoint chart_of(Vector3 d) {
  return {std::atan2(d.x, d.z) * 180 / kPi, std::asin(std::clamp(d.y, -1.0, 1.0)) * 180 / kPi};
}

// A place at a distance from the whorl, in radians, along the lock that starts under an angle.
ChartPoint along_lock(double angle, double distance) {
  const Vector3 pole = direction(kWhorl), right = unit(cross({0, 1, 0}, pole)), up = cross(pole, right);
  const double turned = angle + kSwirl * distance * distance;
  return chart_of(pole * std::cos(distance) + (right * std::cos(turned) + up * std::sin(turned)) * std::sin(distance));
}

// Clockwise from outside, so that the grid's polygons face out.
double lock_angle(std::uint32_t column) { return -2 * kPi * column / kHairColumns; }

double lock_length(double angle) {
  double distance = 0.2;
  while (distance < 2.6) {
    const ChartPoint at = along_lock(angle, distance);
    if (at.elevation_deg < hairline(at.azimuth_deg)) break;
    distance += 0.004;
  }
  return distance;
}

}  // namespace

void add_hair(HeadBuilder& head) {
  head.begin_part("hair", {1, 1, 1}, 0.3);
  const std::uint32_t first = head.vertex_count();
  std::array<double, kHairColumns> lengths;
  for (std::uint32_t c = 0; c < kHairColumns; ++c) lengths[c] = lock_length(lock_angle(c));
  for (std::uint32_t r = 0; r < kHairRows; ++r)
    for (std::uint32_t c = 0; c < kHairColumns; ++c) {
      const double in_lock = std::cos(2 * kPi * c / kColumnsPerLock);     // 1 on the ridge of a lock, -1 between two
      const double unlike = std::sin(2.0 + 2.3 * (c / kColumnsPerLock));  // locks differ
      // Over the last rows the hair goes down to the skin and a little under it.
      const double t = std::min(1.0, (r + 1) / (kHairRows - 2.0));
      const double tip = 0.038 * (in_lock + 0.7 * unlike);
      const double distance = (lengths[c] + tip) * (1 - square(1 - t) * 0.25 - (1 - t) * 0.70);
      const ChartPoint at = along_lock(lock_angle(c), distance);
      const Vector3 skull = skull_point(at);
      const double front = smooth_step(70, 25, std::abs(at.azimuth_deg)) * smooth_step(80, 60, at.elevation_deg);
      double height = lerp(8.5, 4.0, smooth_step(0.5, 1, t)) + 1.5 * front;
      height += 5.0 * bell(at.azimuth_deg - 12, 38) * bell(at.elevation_deg - 58, 17);
      height += 2.0 * bell(std::abs(at.azimuth_deg) - 95, 50) * bell(at.elevation_deg - 48, 20);
      height += (1.1 * in_lock + 0.5 * unlike) * smooth_step(0.0, 0.45, t);
      if (r + 2 == kHairRows) height = 0.4 * height;
      if (r + 1 == kHairRows) height = -3.0;
      head.add_vertex(skull + unit(skull - Vector3{0, 10, 8}) * height,
                      lerp(kHairDark, kHairLight, 0.36 + (0.20 * in_lock + 0.14 * unlike) * smooth_step(0, 0.4, t)));
    }
  const std::uint32_t whorl =
      head.add_vertex(skull_point(kWhorl) + direction(kWhorl) * 8.3, lerp(kHairDark, kHairLight, 0.36));
  for (std::uint32_t c = 0; c < kHairColumns; ++c) head.add_polygon({first + c, first + (c + 1) % kHairColumns, whorl});
  add_grid(head, first, kHairRows, kHairColumns, true);
}

}  // namespace face::phantom
