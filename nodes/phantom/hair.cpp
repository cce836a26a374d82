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
constexpr std::array<std::array<double, 2>, 14> kHairline = {{{0, 51},
                                                              {14, 52},
                                                              {28, 51},
                                                              {40, 45},
                                                              {50, 35},
                                                              {60, 25},
                                                              {68, 18},
                                                              {75, 15},
                                                              {82, 20},
                                                              {92, 28},
                                                              {108, 26},
                                                              {122, 6},
                                                              {140, -16},
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
  return chart_of(pole * std::cos(distance) +
                  (right * std::cos(turned) + up * std::sin(turned)) * std::sin(distance));
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

Vector3 outward(ChartPoint at) {
  const double d = 0.5;
  const Vector3 u = skull_point({at.azimuth_deg + d, at.elevation_deg}) - skull_point({at.azimuth_deg - d, at.elevation_deg});
  const Vector3 v = skull_point({at.azimuth_deg, at.elevation_deg + d}) - skull_point({at.azimuth_deg, at.elevation_deg - d});
  return unit(cross(u, v));
}

}  // namespace

void add_hair(HeadBuilder& head) {
  head.begin_part("hair", {1, 1, 1}, 0.3);
  const std::uint32_t first = head.vertex_count();
  std::array<double, kHairColumns> lengths;
  for (std::uint32_t c = 0; c < kHairColumns; ++c) lengths[c] = lock_length(lock_angle(c));
  for (std::uint32_t r = 0; r < kHairRows; ++r)
    for (std::uint32_t c = 0; c < kHairColumns; ++c) {
      const double in_lock = std::cos(2 * kPi * c / kColumnsPerLock);  // 1 on the ridge of a lock, -1 between two
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
  const std::uint32_t whorl = head.add_vertex(skull_point(kWhorl) + direction(kWhorl) * 8.3, lerp(kHairDark, kHairLight, 0.36));
  for (std::uint32_t c = 0; c < kHairColumns; ++c) head.add_polygon({first + c, first + (c + 1) % kHairColumns, whorl});
  add_grid(head, first, kHairRows, kHairColumns, true);
}

namespace {

// The skin's vertices about a point, the nearest with the largest weight; weights sum to 1.
std::vector<Anchor> nearby(const HeadBuilder& head, const Skin& skin, Vector3 point) {
  std::vector<Anchor> anchors;
  double sum = 0;
  for (std::uint32_t v = 0; v < skin.vertices.size(); ++v) {
    const double d = length(head.points_mm[v] - point);
    if (d > 9) continue;
    anchors.push_back({v, bell(d, 3.5)});
    sum += anchors.back().weight;
  }
  for (Anchor& anchor : anchors) anchor.weight /= sum;
  return anchors;
}

}  // namespace

Attached add_brows(HeadBuilder& head, const Skin& skin) {
  Attached brows;
  brows.range.first = head.vertex_count();
  const auto first_polygon = static_cast<std::uint32_t>(head.polygon_starts.size() - 1);
  head.begin_part("brows", {0.27, 0.175, 0.12}, 0.1);
  constexpr std::uint32_t kColumns = 22, kRows = 5;
  for (std::uint32_t c = 0; c < kColumns; ++c) {
    const double t = c / (kColumns - 1.0);
    const double azimuth = lerp(6.5, 35.0, t);
    const double elevation = 31.6 + 2.0 * std::sin(kPi * t * 0.85) - 2.4 * t * t * t;
    const double half_width = 1.55 * std::pow(std::sin(kPi * lerp(0.14, 0.985, std::pow(t, 0.75))), 0.7);  // degrees
    for (std::uint32_t r = 0; r < kRows; ++r) {
      const double w = r / (kRows - 1.0) * 2 - 1;
      const ChartPoint at = {azimuth - 0.5 * w * (1 - t), elevation + w * half_width};
      const Vector3 point = skin_point(at) + outward(at) * lerp(-0.6, 1.7, std::sqrt(1 - w * w) * smooth_step(-0.1, 0.25, t) *
                                                                              smooth_step(1.12, 0.7, t));
      head.add_vertex(point, {1, 1, 1});
      brows.anchors.push_back(nearby(head, skin, point));
    }
  }
  for (std::uint32_t c = 0; c + 1 < kColumns; ++c)
    for (std::uint32_t r = 0; r + 1 < kRows; ++r) {
      const std::uint32_t a = brows.range.first + c * kRows + r, b = a + kRows;
      head.add_polygon({a, b, b + 1, a + 1});
    }
  const std::uint32_t polygons = head.parts.back().polygon_count;
  head.add_mirror_image("brows", brows.range.first, first_polygon);
  head.parts.pop_back();
  head.parts.back().polygon_count = 2 * polygons;
  mirror_anchors(head, brows);
  brows.range.end = head.vertex_count();
  return brows;
}

namespace {

// Height of the ear's front over its plane, from the middle of the bowl to the rim, mm.
double ear_relief(double rho, double turn_deg) {
  const double lobe = smooth_step(40, 10, std::abs(turn_deg - 270));   // flat below
  const double front = smooth_step(60, 25, std::min(turn_deg, 360 - turn_deg));
  const double detail = (1 - 0.85 * lobe) * (1 - 0.7 * front);
  double h = -7.5 * bell(rho, 0.42) * (1 - 0.5 * lobe);
  h += detail * (2.2 * bell(rho - 0.62, 0.12) - 1.6 * bell(rho - 0.78, 0.07) + 2.6 * bell(rho - 0.93, 0.09));
  h += 3.2 * front * bell(rho - 0.5, 0.2) * (turn_deg > 180 ? 1.0 : 0.6);  // tragus
  return h;
}

}  // namespace

void add_ears(HeadBuilder& head) {
  const std::uint32_t first = head.vertex_count();
  const auto first_polygon = static_cast<std::uint32_t>(head.polygon_starts.size() - 1);
  head.begin_part("ears", {1, 1, 1}, 0.25);
  constexpr std::array<double, 15> kRho = {0.08, 0.2, 0.32, 0.44, 0.53, 0.62, 0.70, 0.78, 0.85, 0.92, 0.97, 1.0, 0.99, 0.92, 0.72};
  constexpr std::uint32_t kColumns = 44;
  for (std::size_t r = 0; r < kRho.size(); ++r)
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      const double turn = 2 * kPi * c / kColumns, rho = kRho[r];
      const bool back = r > 11;
      // Outline: wide above, a lobe below, leaning back. a runs to the front, b up.
      const double sb = std::sin(turn), ca = std::cos(turn);
      const double b = rho * 31 * sb;
      const double a = rho * (ca * (15.5 + 4.0 * sb) - 4.5 * sb) + (1 - rho) * 3;
      const double stand = lerp(15.0, 0.0, smooth_step(-20, 15, a));  // the back edge stands off the head
      double h = stand + 2.0 + ear_relief(rho, turn * 180 / kPi);
      if (r < 9 && a < 10) h = std::max(h, 1.2);
      if (r == 11) h = stand + 1.5;
      if (r == 12) h = stand - 1.0;
      if (r == 13) h = 0.6 * stand - 3.0;
      if (back && r == 14) h = -4;
      h -= 5.0 * smooth_step(9, 17, a);  // the front edge sinks into the cheek
      const Vector3 on_side = {70, 11.5 + b, -1.5 + a};
      const Vector3 skull = skull_point(to_chart(on_side));
      const double red = bell(rho - 0.95, 0.2) * 0.5 + 0.5 * bell(rho, 0.3);
      const double shade = 1 - 0.35 * bell(rho, 0.28);
      head.add_vertex({skull.x + h, on_side.y, on_side.z - 0.35 * h * (stand / 15)},
                      lerp(Vector3{0.90, 0.70, 0.60}, Vector3{0.90, 0.56, 0.48}, red) * shade);
    }
  add_grid(head, first, static_cast<std::uint32_t>(kRho.size()), kColumns, true);
  const Vector3 bowl = head.points_mm[first];
  const std::uint32_t middle = head.add_vertex({bowl.x, 11.5, 1.5}, head.colors_srgb[first]);
  for (std::uint32_t c = 0; c < kColumns; ++c) head.add_polygon({first + c, first + (c + 1) % kColumns, middle});
  const std::uint32_t polygons = head.parts.back().polygon_count;
  head.add_mirror_image("ears", first, first_polygon);
  head.parts.pop_back();
  head.parts.back().polygon_count = 2 * polygons;
}

}  // namespace face::phantom
