// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/head_raster.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/base/find_landmark.h"

namespace face::track {
namespace {

using Place = std::complex<double>;

// How far a face stands out before the inner corners of the eyes, in their distance: the neutral head of ICT-FaceKit
// (Li et al., Learning Formation of Physically-Based Face Attributes, CVPR 2020), at 0, 0.2, ... 1.6 to the side, rows
// from 0.9 above the eyes to 1.35 below, 0.15 apart.
constexpr std::size_t depth_columns = 9, depth_rows = 16;
constexpr double depth_left_step = 0.2, depth_top = -0.9, depth_row_step = 0.15;
constexpr std::array<std::array<double, depth_columns>, depth_rows> depths = {{
    {0.39, 0.40, 0.38, 0.34, 0.26, 0.14, -0.01, -0.20, -0.48},  // forehead
    {0.42, 0.42, 0.40, 0.37, 0.32, 0.23, 0.08, -0.11, -0.42},
    {0.42, 0.41, 0.41, 0.36, 0.30, 0.23, 0.14, -0.04, -0.42},
    {0.40, 0.38, 0.32, 0.29, 0.20, 0.17, 0.09, -0.05, -0.34},
    {0.38, 0.32, 0.21, 0.15, 0.13, 0.12, 0.02, -0.10, -0.36},
    {0.40, 0.32, 0.09, 0.08, 0.08, 0.06, 0.00, -0.20, -0.41},
    {0.50, 0.31, 0.08, 0.08, 0.08, 0.04, -0.08, -0.28, -0.49},  // eyes
    {0.60, 0.45, 0.12, 0.07, 0.09, 0.07, -0.04, -0.23, -0.44},
    {0.71, 0.58, 0.25, 0.11, 0.08, 0.04, -0.05, -0.16, -0.34},
    {0.87, 0.72, 0.40, 0.16, 0.11, 0.04, -0.04, -0.13, -0.33},
    {0.96, 0.87, 0.42, 0.23, 0.16, 0.09, 0.03, -0.05, -0.28},
    {1.03, 0.96, 0.68, 0.27, 0.19, 0.13, 0.07, -0.06, -0.23},  // tip of the nose
    {1.04, 0.97, 0.74, 0.28, 0.22, 0.17, 0.08, -0.07, -0.28},
    {0.90, 0.56, 0.56, 0.28, 0.23, 0.19, 0.10, -0.07, -0.33},
    {0.65, 0.57, 0.41, 0.35, 0.26, 0.18, 0.05, -0.07, -0.47},
    {0.63, 0.63, 0.50, 0.36, 0.28, 0.19, 0.07, -0.20, -0.50},  // upper lip
}};
constexpr double tip_below = 0.77;  // of the same head: how far its tip of the nose is below the eyes

double depth_at(double x, double y) {
  const double u = std::clamp(std::abs(x) / depth_left_step, 0.0, depth_columns - 1.001);
  const double v = std::clamp((y - depth_top) / depth_row_step, 0.0, depth_rows - 1.001);
  const auto i = static_cast<std::size_t>(u), j = static_cast<std::size_t>(v);
  const double p = u - std::floor(u), q = v - std::floor(v);
  return (1 - q) * ((1 - p) * depths[j][i] + p * depths[j][i + 1]) +
         q * ((1 - p) * depths[j + 1][i] + p * depths[j + 1][i + 1]);
}

// Cheeks below the outer corners of the eyes move when one smiles, the hair hangs over temples, and lids and eyes move
// by themselves.
bool is_solid(double x, double y) {
  constexpr double eye_x = 0.87, eye_y = -0.04, half_width = 0.45, half_height = 0.28;
  if (std::hypot((std::abs(x) - eye_x) / half_width, (y - eye_y) / half_height) < 1) return false;
  const double low = std::max(0.0, y - 0.3), high = std::max(0.0, -0.5 - y);
  return std::abs(x) + 0.75 * low + 0.8 * high <= 1.6;
}

}  // namespace

RasterFrame raster_frame(const Landmarks& start) {
  const Landmark *right = find_landmark(start, "eye_inner_r"), *left = find_landmark(start, "eye_inner_l"),
                 *tip = find_landmark(start, "nose_tip");
  if (right == nullptr || left == nullptr || tip == nullptr) return {};
  const Place a(right->x_px, right->y_px), b(left->x_px, left->y_px), middle = (a + b) / 2.0;
  constexpr double least_px = 4, shortest = 0.8, longest = 1.3;
  if (std::abs(b - a) < least_px) return {};
  const double below = ((Place(tip->x_px, tip->y_px) - middle) / (b - a)).imag();
  return {middle, b - a, std::clamp(below / tip_below, shortest, longest), true};
}

std::vector<Knot> raster_knots(const RasterFrame& frame, int stride) {
  std::vector<Knot> knots;
  for (int row = 0; row < raster_rows; row += stride)
    for (int column = 0; column < raster_columns; column += stride) {
      const double x = raster_left + raster_step * column, y = raster_top + raster_step * row;
      knots.push_back({static_cast<std::size_t>(row * raster_columns + column), frame.across * Place(x, y),
                       depth_at(x, y > 0 ? y / frame.stretch : y) * std::abs(frame.across), is_solid(x, y)});
    }
  return knots;
}

}  // namespace face::track
