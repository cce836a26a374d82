// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/ears.h"

#include <array>
#include <numbers>

#include "nodes/phantom/head_surface.h"

namespace face::phantom {
namespace {

constexpr double kPi = std::numbers::pi;

// Height of the ear's front over its plane, from the middle of the bowl to the rim, mm.
double ear_relief(double rho, double turn_deg) {
  const double lobe = smooth_step(40, 10, std::abs(turn_deg - 270));  // flat below
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
  constexpr std::array<double, 15> kRho = {0.08, 0.2,  0.32, 0.44, 0.53, 0.62, 0.70, 0.78,
                                           0.85, 0.92, 0.97, 1.0,  0.99, 0.92, 0.72};
  constexpr std::uint32_t kColumns = 36;
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
