// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/mouth_shape.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"

namespace face::track {

using Vector2 = Eigen::Vector2d;

std::vector<std::size_t> find_outline(const Landmarks& start, const std::vector<std::string>& names) {
  std::vector<std::size_t> outline;
  std::string missing;
  for (const std::string& name : names) {
    const std::size_t index = landmark_index(start, name);
    if (index == start.points.size())
      missing += (missing.empty() ? "" : ", ") + name;
    else
      outline.push_back(index);
  }
  if (outline.empty()) return {};
  if (!missing.empty())
    fail("start has ", outline.size(), " of the outline's ", names.size(), " points, expected all or none: ", missing,
         outline.size() + 1 == names.size() ? " is" : " are", " missing");
  check(outline.size() >= 6 && outline.size() % 2 == 0, "outline has ", outline.size(),
        " points, expected an even number from 6");
  return outline;
}

std::vector<std::vector<double>> mouth_modes(const Landmarks& start, const std::vector<std::size_t>& outline,
                                             const std::vector<std::size_t>& jaw_line) {
  if (outline.empty()) return {};
  const std::size_t size = 2 * start.points.size(), half = outline.size() / 2;
  const auto at = [&](std::size_t k) {
    const Landmark& p = start.points[outline[k]];
    return Vector2(p.x_px, p.y_px);
  };
  const Vector2 centre = (at(0) + at(half)) / 2, radius = (at(half) - at(0)) / 2;
  const double width = radius.norm();
  check(width > 1e-6, "the corners of the outline lie on each other");
  const Vector2 right = radius / width, down(-right.y(), right.x());
  std::vector<std::vector<double>> modes;
  // u: place across the mouth, -1 to 1; upper: 1 on the upper lip, -1 on the lower, 0 at the corners.
  const auto add = [&](double size_px, auto&& offset) {
    std::vector<double> mode(size, 0.0);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const double u = (at(k) - centre).dot(right) / width;
      const int upper = k % half == 0 ? 0 : k < half ? 1 : -1;
      const Vector2 move = size_px * offset(u, upper);
      mode[2 * outline[k]] = move.x();
      mode[2 * outline[k] + 1] = move.y();
    }
    modes.push_back(std::move(mode));
  };
  const auto hump = [](double u) { return std::max(0.0, 1 - u * u); };
  add(0.10 * width, [&](double, int) { return right; });
  add(0.15 * width, [&](double, int) { return down; });
  add(0.12 * width, [&](double u, int) { return Vector2(u * right); });
  add(0.06 * width, [&](double u, int) { return Vector2(u * down); });
  add(0.25 * width, [&](double u, int upper) { return Vector2((upper < 0 ? hump(u) : 0.0) * down); });
  add(0.12 * width, [&](double u, int upper) { return Vector2((upper > 0 ? hump(u) : 0.0) * down); });
  add(0.06 * width, [&](double u, int) { return Vector2(u * u * down); });
  add(0.06 * width, [&](double u, int upper) { return Vector2((upper < 0 ? u * hump(u) : 0.0) * down); });
  add(0.04 * width, [&](double u, int upper) { return Vector2((upper > 0 ? u * hump(u) : 0.0) * down); });
  add(0.06 * width, [&](double u, int) { return Vector2(u * u * right); });
  if (jaw_line.empty()) return modes;
  const auto move_jaw = [&](std::vector<double>& mode, auto&& offset) {
    for (std::size_t k = 0; k < jaw_line.size(); ++k) {
      const double u = jaw_line.size() > 1 ? 2.0 * static_cast<double>(k) / (jaw_line.size() - 1.0) - 1 : 0;
      const Vector2 move = offset(u);
      mode[2 * jaw_line[k]] = move.x();
      mode[2 * jaw_line[k] + 1] = move.y();
    }
  };
  move_jaw(modes[lower_lip_mode], [&](double) { return Vector2(0.8 * 0.25 * width * down); });
  const auto add_jaw = [&](auto&& offset) {
    modes.emplace_back(size, 0.0);
    move_jaw(modes.back(), offset);
  };
  add_jaw([&](double) { return Vector2(0.05 * width * right); });
  add_jaw([&](double) { return Vector2(0.12 * width * down); });
  add_jaw([&](double u) { return Vector2(0.03 * width * u * right); });
  add_jaw([&](double u) { return Vector2(0.03 * width * u * down); });
  return modes;
}

double mouth_width_px(const Landmarks& start, const std::vector<std::size_t>& outline) {
  const Landmark &a = start.points[outline[0]], &b = start.points[outline[outline.size() / 2]];
  return std::hypot(b.x_px - a.x_px, b.y_px - a.y_px);
}

}  // namespace face::track
