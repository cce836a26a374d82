// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/head_surface.h"

#include <array>
#include <numbers>

namespace face::phantom {
namespace {

constexpr double kStepDeg = 9;
constexpr int kColumns = 21;  // azimuth 0, 9, ..., 180
constexpr int kRows = 15;     // elevation 81, 72, ..., -45
constexpr Vector3 kCentre = {0, 0, 15};
constexpr double kCrownRadius = 144;

// Distance of the skin from kCentre in mm; rows from elevation 81 down to -45, columns from the front to the back.
// Read off the neutral head of ICT-FaceKit (Li et al., Learning Formation of Physically-Based Face Attributes, CVPR
// 2020; MIT licence), rounded, with nose and ears taken away and the forms softened. They are the control net of a
// uniform cubic B-spline, which is why the surface is smooth.
constexpr std::array<std::array<double, kColumns>, kRows> kRadius = {{
    {142, 142, 142, 142, 142, 142, 142, 142, 142, 143, 143, 143, 144, 144, 145, 145, 146, 146, 146, 146, 147},
    {140, 140, 140, 139, 139, 138, 138, 138, 138, 138, 138, 139, 141, 142, 143, 145, 146, 147, 147, 148, 148},
    {137, 137, 136, 135, 134, 133, 132, 131, 131, 131, 131, 133, 135, 137, 140, 142, 143, 145, 145, 146, 146},
    {132, 132, 131, 130, 127, 125, 123, 122, 121, 121, 122, 123, 126, 130, 133, 136, 138, 139, 140, 140, 141},
    {125, 125, 124, 122, 119, 115, 112, 109, 108, 108, 109, 111, 115, 119, 123, 126, 129, 131, 133, 133, 133},
    {116, 116, 115, 113, 110, 105, 100, 97, 96, 95, 96, 99, 102, 107, 111, 115, 119, 121, 123, 124, 124},
    {102, 101, 99, 101, 101, 97, 92, 88, 87, 86, 86, 88, 91, 95, 100, 104, 108, 111, 113, 113, 114},
    {95, 90, 89, 91, 92, 90, 87, 84, 81, 80, 80, 81, 83, 86, 90, 94, 98, 101, 103, 104, 104},
    {94, 91, 89, 90, 92, 89, 85, 81, 78, 76, 75, 75, 77, 79, 83, 86, 89, 92, 93, 94, 95},
    {96, 94, 92, 92, 91, 88, 83, 79, 76, 73, 71, 71, 72, 74, 77, 79, 82, 84, 86, 86, 87},
    {99, 97, 94, 93, 90, 86, 81, 77, 74, 71, 70, 69, 69, 71, 73, 75, 77, 79, 80, 81, 81},
    {104, 102, 98, 93, 89, 85, 80, 76, 73, 70, 68, 67, 68, 70, 72, 73, 75, 77, 78, 79, 79},
    {107, 106, 101, 96, 90, 85, 81, 77, 74, 71, 69, 69, 71, 72, 73, 74, 76, 78, 80, 81, 82},
    {118, 115, 107, 99, 93, 87, 82, 78, 75, 73, 72, 74, 76, 77, 78, 79, 82, 85, 87, 88, 89},
    {108, 107, 102, 97, 91, 86, 82, 78, 76, 76, 78, 81, 85, 86, 88, 90, 95, 99, 101, 103, 103},
}};

// The neck below the table, from under the jaw down: centre and half-axes of each control loop, in mm.
struct NeckLoop {
  double front_y, back_y, front_z, back_z, half_width;
};
constexpr std::array<NeckLoop, 5> kNeck = {{{-82, -84, 48, -58, 56},
                                            {-100, -98, 40, -58, 54},
                                            {-116, -108, 38, -60, 56},
                                            {-132, -122, 40, -63, 60},
                                            {-146, -136, 44, -68, 70}}};

double radians(double deg) { return deg * std::numbers::pi / 180; }

// Control point of the net: row 0 is elevation -45, rows above it the table, rows below it the neck.
Vector3 control_point(int column, int row) {
  column = ((column % 40) + 40) % 40;
  const bool right = column > 20;
  if (right) column = 40 - column;
  const double side = right ? -1 : 1;
  if (row < 0) {
    const NeckLoop& loop = kNeck[static_cast<std::size_t>(std::min(-row - 1, 4))];
    const double a = radians(kStepDeg * column), front = 0.5 + 0.5 * std::cos(a);
    const double middle_z = 0.5 * (loop.front_z + loop.back_z), half_z = 0.5 * (loop.front_z - loop.back_z);
    return {side * loop.half_width * std::sin(a), lerp(loop.back_y, loop.front_y, front),
            middle_z + half_z * std::cos(a)};
  }
  double elevation = -45 + kStepDeg * row, radius = kCrownRadius;
  int table_column = column;
  if (row > 15) {  // beyond the crown: down the other side
    row = 30 - row;
    table_column = 20 - column;
  }
  if (row < 15) radius = kRadius[static_cast<std::size_t>(14 - row)][static_cast<std::size_t>(table_column)];
  const double a = radians(kStepDeg * column), e = radians(elevation);
  return kCentre + radius * Vector3{side * std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

std::array<double, 4> spline_weights(double t) {
  const double u = 1 - t;
  return {u * u * u / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * u * u * u - 6 * u * u + 4) / 6, t * t * t / 6};
}

// Piecewise cubic through (x, y) knots in falling order of x, flat at the ends (monotone enough for profiles).
template <std::size_t N>
double profile(const std::array<std::array<double, 2>, N>& knots, double x) {
  if (x >= knots.front()[0]) return knots.front()[1];
  if (x <= knots.back()[0]) return knots.back()[1];
  std::size_t i = 0;
  while (x < knots[i + 1][0]) ++i;
  const auto slope = [&](std::size_t k) {
    if (k == 0 || k + 1 == N) return 0.0;
    return (knots[k + 1][1] - knots[k - 1][1]) / (knots[k + 1][0] - knots[k - 1][0]);
  };
  const double h = knots[i + 1][0] - knots[i][0], t = (x - knots[i][0]) / h;
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * knots[i][1] + (t3 - 2 * t2 + t) * h * slope(i) + (3 * t2 - 2 * t3) * knots[i + 1][1] +
         (t3 - t2) * h * slope(i + 1);
}

// Height of the nose's ridge over the face and its half width, by height y in mm.
constexpr std::array<std::array<double, 2>, 10> kNoseRidge = {
    {{44, 0}, {34, 4.5}, {26, 7.5}, {18, 11}, {11, 15.5}, {6, 18}, {1, 17}, {-4, 11}, {-9, 4}, {-14, 0}}};
constexpr std::array<std::array<double, 2>, 6> kNoseWidth = {
    {{44, 8}, {30, 7.2}, {20, 8}, {10, 9.5}, {0, 11}, {-14, 9}}};

// 1 in the middle of a nostril, 0 away from it.
double nostril_weight(Vector3 at) {
  const double x = std::abs(at.x) - 5.9, y = at.y + 6.6;
  return std::exp(-std::pow(square(x / 3.3) + square((y - 0.25 * x) / 3.0), 1.6));
}

Vector3 nose_offset(Vector3 at) {
  const double x = std::abs(at.x), y = at.y;
  if (x > 40 || y > 60 || y < -40 || at.z < 40) return {};
  double dz = profile(kNoseRidge, y) * std::exp(-std::pow(x / profile(kNoseWidth, y), 2.6));
  dz += 3.0 * bell(x, 7.5) * bell(y - 4, 6.5);           // tip
  dz += 9.0 * bell(x - 11.2, 4.4) * bell(y + 2.2, 5.2);  // wings
  dz -= 2.0 * bell(x - 17.5, 3.2) * bell(y + 3, 7);      // crease beside the wing
  // The underside: what slopes from the tip back to the lip is drawn together into a nearly level floor.
  const double under = bell(x, 15) * smooth_step(2, -5, y) * smooth_step(-19, -11, y);
  double dy = (-6.5 - y) * 0.70 * under;
  const double nostril = nostril_weight(at);
  dy += 4.2 * nostril;
  dz -= 2.0 * nostril;
  return {0, dy, dz};
}

}  // namespace

Vector3 skull_point(ChartPoint at) {
  const double u = at.azimuth_deg / kStepDeg, v = (at.elevation_deg + 45) / kStepDeg;
  const int i = static_cast<int>(std::floor(std::abs(u))), j = static_cast<int>(std::floor(v));
  const std::array<double, 4> wu = spline_weights(std::abs(u) - i), wv = spline_weights(v - j);
  Vector3 sum;
  for (int b = 0; b < 4; ++b)
    for (int a = 0; a < 4; ++a)
      sum += wu[static_cast<std::size_t>(a)] * wv[static_cast<std::size_t>(b)] * control_point(i + a - 1, j + b - 1);
  if (u < 0) sum.x = -sum.x;
  return sum;
}

Vector3 skin_point(ChartPoint at) {
  const Vector3 skull = skull_point(at);
  return skull + nose_offset(skull);
}

double nostril_darkness(ChartPoint at) {
  if (std::abs(at.azimuth_deg) > 20 || std::abs(at.elevation_deg) > 20) return 0;
  return smooth_step(0.35, 0.95, nostril_weight(skull_point(at)));
}

ChartPoint to_chart(Vector3 point_mm) {
  const Vector3 d = point_mm - kCentre;
  return {std::atan2(d.x, d.z) * 180 / std::numbers::pi,
          std::atan2(d.y, std::sqrt(d.x * d.x + d.z * d.z)) * 180 / std::numbers::pi};
}

}  // namespace face::phantom
