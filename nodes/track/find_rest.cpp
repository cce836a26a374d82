// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/find_rest.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"

namespace face::track {
namespace {

double y_of(const Landmarks& landmarks, int lip) {
  const std::string name = "lip_" + std::to_string(lip);
  for (const Landmark& point : landmarks.points)
    if (point.name == name) return point.y_px;
  fail("there is no point ", name, ", expected lip_1 to lip_5 and lip_7 to lip_11");
}

double lip_height(const Landmarks& landmarks) {
  double height = 0;
  for (int i = 1; i <= 5; ++i) height += (y_of(landmarks, 12 - i) - y_of(landmarks, i)) / 5;
  return height;
}

}  // namespace

Landmarks find_rest(const engine::Seq<Landmarks>& landmarks, const FindRestOptions& options) {
  check(!landmarks.empty(), "there are no frames");
  check(options.from_share >= 0 && options.from_share <= options.to_share && options.to_share <= 1,
        "from_share and to_share are ", options.from_share, " and ", options.to_share,
        ", expected two of 0 to 1 in this order");
  std::vector<std::pair<double, std::size_t>> heights;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const auto here = landmarks.at(i);
    if (std::all_of(here->points.begin(), here->points.end(), [](const Landmark& point) { return point.valid; }))
      heights.emplace_back(lip_height(*here), i);
  }
  Landmarks rest = *landmarks.at(heights.empty() ? 0 : heights[0].second);
  if (heights.empty()) return rest;
  std::sort(heights.begin(), heights.end());
  const auto last = static_cast<double>(heights.size() - 1);
  const auto begin = static_cast<std::size_t>(options.from_share * last + 0.5);
  const auto end = static_cast<std::size_t>(options.to_share * last + 0.5) + 1;
  for (Landmark& point : rest.points) point.x_px = point.y_px = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const auto here = landmarks.at(heights[i].second);
    check(here->points.size() == rest.points.size(), "frame ", landmarks.id(heights[i].second), " has ",
          here->points.size(), " points, expected ", rest.points.size());
    for (std::size_t p = 0; p < rest.points.size(); ++p) {
      rest.points[p].x_px += here->points[p].x_px / static_cast<double>(end - begin);
      rest.points[p].y_px += here->points[p].y_px / static_cast<double>(end - begin);
    }
  }
  return rest;
}

}  // namespace face::track
