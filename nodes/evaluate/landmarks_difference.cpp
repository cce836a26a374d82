// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/landmarks_difference.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "nodes/evaluate/statistics.h"
#include "nodes/render/points_still.h"

namespace face::evaluate {

LandmarksDifferenceResult landmarks_difference(const Landmarks& a, const Landmarks& b) {
  std::map<std::string, const Landmark*> others;
  for (const Landmark& point : b.points) others.emplace(point.name, &point);
  LandmarksDifferenceResult result{{{"rms_px", "largest_px", "lost_in_a", "lost_in_b"}, {{"all", {}}}}, {}};
  std::vector<double> distances;
  double lost_a = 0, lost_b = 0;
  std::map<std::string, bool> valid_in_a;
  for (const Landmark& point : a.points) {
    valid_in_a[point.name] = point.valid;
    const auto other = others.find(point.name);
    if (other == others.end() || !other->second->valid) {
      lost_b += point.valid;
      continue;
    }
    if (!point.valid) continue;
    const double distance = std::hypot(point.x_px - other->second->x_px, point.y_px - other->second->y_px);
    distances.push_back(distance);
    if (distance > 0) result.table.rows.push_back({point.name, {distance, distance, 0, 0}});
  }
  for (const Landmark& point : b.points) {
    const auto own = valid_in_a.find(point.name);
    lost_a += point.valid && (own == valid_in_a.end() || !own->second);
  }
  result.table.rows[0].values = {rms_of(distances), largest_of(distances), lost_a, lost_b};
  Landmarks both = a;
  for (Landmark& point : both.points) point.valid = true;
  for (Landmark point : b.points) {
    point.valid = false;
    both.points.push_back(point);
  }
  result.picture = render::landmarks_still(both);
  return result;
}

}  // namespace face::evaluate
