// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/marker_points.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

namespace face::align {
namespace {

// Depth of a plane fitted to the measured pixels about a place; 0 where fewer than 12 of 81 are.
float plane_depth(const DepthScan& scan, double x_px, double y_px) {
  const int cx = static_cast<int>(std::lround(x_px)), cy = static_cast<int>(std::lround(y_px));
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  int count = 0;
  for (int y = std::max(cy - 4, 0); y <= std::min(cy + 4, scan.picture.height - 1); ++y)
    for (int x = std::max(cx - 4, 0); x <= std::min(cx + 4, scan.picture.width - 1); ++x) {
      const auto depth = static_cast<double>(scan.depth_mm[static_cast<std::size_t>(y * scan.picture.width + x)]);
      if (!(depth > 0)) continue;
      const Eigen::Vector3d row(x - x_px, y - y_px, 1);
      a += row * row.transpose();
      b += row * depth;
      ++count;
    }
  if (count < 12) return 0;
  return static_cast<float>(Eigen::Vector3d(a.ldlt().solve(b))(2));
}

}  // namespace

std::vector<MarkerPoint> marker_points(const DepthScan& scan, const Landmarks& markers) {
  std::map<std::string, MarkerPoint> found;
  for (const Landmark& marker : markers.points) {
    if (!marker.valid) continue;
    const float depth = plane_depth(scan, marker.x_px, marker.y_px);
    if (depth > 0) found[marker.name] = {marker.name, marker.x_px, marker.y_px, static_cast<double>(depth)};
  }
  std::vector<MarkerPoint> out;
  for (auto& [name, point] : found) out.push_back(std::move(point));
  return out;
}

}  // namespace face::align
