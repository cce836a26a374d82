// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/outline_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/render/triangulate.h"

namespace face::model {
namespace {

constexpr double rim_cosine = 0.1;   // of normal and line of sight
constexpr double reach_px = 5;       // of the level, along the normal
constexpr double least_edge = 0.03;  // change of colour per pixel of the level, from 0 to 1
constexpr double step_px = 0.5;

// Change of colour along a direction between pixels; 0 outside.
double edge_at(const PictureLevel& level, double x, double y, double nx, double ny) {
  const auto column = static_cast<int>(std::lround(x)), row = static_cast<int>(std::lround(y));
  if (column < 0 || row < 0 || column >= level.width || row >= level.height) return 0;
  const std::array<float, 9>& s = level.samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(level.width) +
                                                static_cast<std::size_t>(column)];
  double squares = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double along = nx * static_cast<double>(s[3 + c]) + ny * static_cast<double>(s[6 + c]);
    squares += along * along;
  }
  return std::sqrt(squares / 3);
}

}  // namespace

LandmarkBasis outline_basis(const MorphableModel& model, std::size_t identities, std::size_t expressions) {
  Landmarks any;
  any.points.push_back({"contour_0", 0, 0, true});
  LandmarkBasis basis = make_landmark_basis(model, any, identities, expressions);
  basis.points.clear();
  return basis;
}

LandmarkRows outline_rows(const LandmarkBasis& outline, const std::vector<Vec3f>& posed_mm, const FacePose& pose,
                          const PictureLevel& level) {
  LandmarkRows rows;
  const std::size_t modes = outline.coefficients();
  rows.columns = FacePose::size + modes;
  const std::vector<Vec3f> normals = render::vertex_normals(posed_mm, outline.triangles);
  const Camera camera = camera_of(pose);
  for (const std::uint32_t v : outline.candidates) {
    double dot = 0, length = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double ray = static_cast<double>(posed_mm[v][k]) - camera.position_mm[k];
      dot += ray * normals[v][k];
      length += ray * ray;
    }
    if (std::abs(dot) > rim_cosine * std::sqrt(length)) continue;
    const PoseView seen = view(pose, posed_mm[v]);
    const std::array<double, 3> normal = in_camera(pose, normals[v]);
    double nx = normal[0], ny = -normal[1];  // a picture's y runs down
    const double flat = std::hypot(nx, ny);
    if (flat < 0.5) continue;
    nx /= flat;
    ny /= flat;
    double best = least_edge, place = 0;
    bool found = false;
    for (double t = -reach_px; t <= reach_px; t += step_px) {
      const double strength = edge_at(level, (seen.x_px + 0.5) * level.factor - 0.5 + t * nx,
                                      (seen.y_px + 0.5) * level.factor - 0.5 + t * ny, nx, ny) *
                              std::exp(-t * t / (0.5 * reach_px * reach_px));
      if (strength > best) best = strength, place = t, found = true;
    }
    if (!found || std::abs(place) > reach_px - 2 * step_px) continue;
    rows.residual_px.push_back(-place / level.factor);
    const float* offsets = outline.modes.data() + 3 * v * modes;
    for (int k = 0; k < FacePose::size; ++k)
      rows.jacobian.push_back(nx * seen.by_pose[0][static_cast<std::size_t>(k)] +
                              ny * seen.by_pose[1][static_cast<std::size_t>(k)]);
    std::array<double, 3> by_point{};
    for (std::size_t k = 0; k < 3; ++k) by_point[k] = nx * seen.by_point[0][k] + ny * seen.by_point[1][k];
    for (std::size_t k = 0; k < modes; ++k)
      rows.jacobian.push_back(by_point[0] * offsets[k] + by_point[1] * offsets[modes + k] +
                              by_point[2] * offsets[2 * modes + k]);
  }
  return rows;
}

}  // namespace face::model
