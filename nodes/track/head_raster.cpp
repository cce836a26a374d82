// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/head_raster.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/base/find_landmark.h"
#include "nodes/track/solid_head.h"

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
// Of the same head, in the same unit: how far points in the middle are below the eyes and before them.
struct MiddlePlace {
  double below, depth;
};
constexpr MiddlePlace tip{0.77, 1.05}, mouth_middle{1.84, 0.27}, chin_middle{2.93, 0.34};

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

// Lines of sight onto the face of a frame, which the rotation of its facing takes to the picture.
class Sight {
 public:
  explicit Sight(const RasterFrame& frame) : stretch_(frame.stretch) {
    const double n = frame.facing.nod, t = frame.facing.turn;
    from_x_ = {std::cos(t), std::sin(t) * std::sin(n), std::sin(t) * std::cos(n)};
    from_y_ = {0, std::cos(n), -std::sin(n)};
    from_depth_ = {-std::sin(t), std::cos(t) * std::sin(n), std::cos(t) * std::cos(n)};
  }

  struct Meeting {
    double depth;  // towards the viewer, in distances of the eyes
    bool solid;
  };
  // Where the line of sight of a place of the picture first meets the face: in steps from before it, then halved.
  Meeting at(double x, double y) const {
    constexpr double nearest = 1.8, farthest = -2, step = 0.15;
    constexpr int halvings = 6;  // to 0.0025
    double before = nearest, behind = nearest;
    while (behind > farthest && height(x, y, behind) > 0) before = behind, behind -= step;
    for (int i = 0; i < halvings; ++i) {
      const double middle = (before + behind) / 2;
      (height(x, y, middle) > 0 ? before : behind) = middle;
    }
    const std::array<double, 3> on_face = face_place(x, y, (before + behind) / 2);
    return {(before + behind) / 2, is_solid(on_face[0], on_face[1])};
  }

 private:
  std::array<double, 3> face_place(double x, double y, double depth) const {
    std::array<double, 3> place;
    for (std::size_t k = 0; k < 3; ++k) place[k] = from_x_[k] * x + from_y_[k] * y + from_depth_[k] * depth;
    return place;
  }
  // How far a place of the picture's space is before the face, as seen from its front.
  double height(double x, double y, double depth) const {
    const std::array<double, 3> place = face_place(x, y, depth);
    return place[2] - stretch_ * depth_at(place[0], place[1] > 0 ? place[1] / stretch_ : place[1]);
  }
  double stretch_;
  std::array<double, 3> from_x_, from_y_, from_depth_;  // rows of the rotation: the head's axes of the picture's
};

}  // namespace

RasterFrame raster_frame(const Landmarks& start) {
  const Landmark *right = find_landmark(start, "eye_inner_r"), *left = find_landmark(start, "eye_inner_l"),
                 *nose = find_landmark(start, "nose_tip");
  if (right == nullptr || left == nullptr || nose == nullptr) return {};
  const auto place = [](const Landmark& point) { return Place(point.x_px, point.y_px); };
  constexpr double least_px = 4, shortest = 0.8, longest = 1.3;
  if (distance_px(*right, *left) < least_px) return {};
  std::vector<MiddleMark> marks = {nose_tip_mark(place(*nose), tip.below, tip.depth)};
  if (const Landmark* a = find_landmark(start, "lip_0"), *b = find_landmark(start, "lip_6");
      a != nullptr && b != nullptr)
    marks.push_back(mouth_mark((place(*a) + place(*b)) / 2.0, mouth_middle.below, mouth_middle.depth));
  if (const Landmark* chin = find_landmark(start, "chin"); chin != nullptr)
    marks.push_back(chin_mark(place(*chin), chin_middle.below, chin_middle.depth));
  const HeadFacing facing = head_facing(place(*right), place(*left), marks);
  const double below = ((place(*nose) - facing.middle_px) / facing.unit_px).imag();
  const double usual = std::cos(facing.nod) * tip.below - std::sin(facing.nod) * tip.depth;
  return {facing.middle_px, facing.unit_px, facing, std::clamp(below / usual, shortest, longest), true};
}

std::vector<Knot> raster_knots(const RasterFrame& frame, int stride) {
  const Sight sight(frame);
  std::vector<Knot> knots;
  for (int row = 0; row < raster_rows; row += stride)
    for (int column = 0; column < raster_columns; column += stride) {
      const double x = raster_left + raster_step * column, y = raster_top + raster_step * row;
      const auto [depth, solid] = sight.at(x, y);
      knots.push_back({static_cast<std::size_t>(row * raster_columns + column), frame.across * Place(x, y),
                       depth * std::abs(frame.across), solid});
    }
  return knots;
}

std::vector<double> usual_depths_px(const Landmarks& start) {
  const RasterFrame frame = raster_frame(start);
  if (!frame.valid) return {};
  std::vector<double> depths_px;
  for (const Landmark& point : start.points) {
    const double depth = usual_depth(point.name);
    if (depth < 0) return {};
    depths_px.push_back(
        frame.facing.depth_px({point.x_px, point.y_px}, depth * frame.stretch * std::abs(frame.across)));
  }
  return depths_px;
}

}  // namespace face::track
