// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/hair.h"

#include <array>
#include <numbers>

#include "nodes/phantom/head_surface.h"

namespace face::phantom {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Vector3 kHairDark = {0.17, 0.105, 0.075}, kHairLight = {0.40, 0.26, 0.17};

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
  std::size_t i = 0;
  while (i + 2 < kHairline.size() && a > kHairline[i + 1][0]) ++i;
  const double t = (a - kHairline[i][0]) / (kHairline[i + 1][0] - kHairline[i][0]);
  return lerp(kHairline[i][1], kHairline[i + 1][1], t * t * (3 - 2 * t));
}

constexpr int kHairColumns = 96, kHairRows = 22;

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
  for (int r = 0; r < kHairRows; ++r)
    for (int c = 0; c < kHairColumns; ++c) {
      const int side = c <= kHairColumns / 2 ? c : kHairColumns - c;
      const double azimuth = 360.0 * side / kHairColumns;
      const double t = std::max(0, r - 1) / (kHairRows - 1.0);
      const double line = hairline(azimuth), elevation = lerp(line, 89.0, t);
      const double depth = (elevation - line) * 1.9;  // mm from the hairline, roughly
      const double front = smooth_step(60, 20, azimuth);
      const double lock = std::cos(azimuth * kPi / 180 * 15 + 0.05 * elevation);
      const double fine = std::cos(azimuth * kPi / 180 * 37 - 0.09 * elevation);
      double height = lerp(3.0, 7.0, front) * smooth_step(-1, 7, depth) + 7 * smooth_step(2, 45, depth);
      height += 5 * front * smooth_step(0, 14, depth) * smooth_step(75, 10, depth);
      height += (1.0 * lock + 0.4 * fine) * smooth_step(2, 12, depth) * smooth_step(89, 62, elevation);
      if (r == 0) height = -2.5;
      const ChartPoint at = {azimuth, std::min(elevation, 89.0)};
      const Vector3 skull = skull_point(at);
      Vector3 point = skull + unit(skull - Vector3{0, 10, 8}) * height;
      if (c > kHairColumns / 2) point.x = -point.x;
      head.add_vertex(point, lerp(kHairDark, kHairLight, 0.3 + 0.2 * lock + 0.1 * fine + 0.3 * smooth_step(30, 85, elevation)));
    }
  for (int r = 0; r < kHairRows; ++r)
    for (int c = 1; c < kHairColumns / 2; ++c) {
      const auto row = first + static_cast<std::uint32_t>(r * kHairColumns);
      head.pair(row + static_cast<std::uint32_t>(c), row + static_cast<std::uint32_t>(kHairColumns - c));
    }
  add_grid(head, first, kHairRows, kHairColumns, true);
  const std::uint32_t crown = head.add_vertex(skull_point({0, 90}) + Vector3{0, 10.0, 0}, kHairLight);
  const std::uint32_t last = first + static_cast<std::uint32_t>((kHairRows - 1) * kHairColumns);
  for (std::uint32_t c = 0; c < kHairColumns; ++c)
    head.add_polygon({last + c, last + (c + 1) % static_cast<std::uint32_t>(kHairColumns), crown});
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
    const double elevation = 32.0 + 2.4 * std::sin(kPi * t * 0.8) - 2.9 * t * t * t;
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
  head.begin_part("ear_left", {1, 1, 1}, 0.25);
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
  head.add_mirror_image("ear_right", first, first_polygon);
}

}  // namespace face::phantom
