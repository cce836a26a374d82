// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/landmark_depths.h"

#include <vector>

#include "nodes/base/check.h"
#include "nodes/meshik/landmark_vertices.h"

namespace face::meshik {

Matrix landmark_depths(const Rig& rig, const Landmarks& neutral) {
  const std::vector<LandmarkVertex> places = landmark_vertices(rig, neutral);
  for (const LandmarkVertex& place : places)
    check(place.vertex < rig.neutral.points_mm.size(), "a landmark is vertex ", place.vertex, ", expected one below ",
          rig.neutral.points_mm.size());
  const double scale_mm = landmark_scale_mm(rig, neutral, places);
  const auto depth = [&](const LandmarkVertex& place) {
    return static_cast<double>(rig.neutral.points_mm[place.vertex][2]) / scale_mm;
  };
  double mean = 0;
  for (const LandmarkVertex& place : places) mean += depth(place) / static_cast<double>(places.size());
  Matrix depths{neutral.points.size(), 1, std::vector<double>(neutral.points.size(), mean)};
  for (const LandmarkVertex& place : places) depths.at(place.landmark, 0) = depth(place);
  return depths;
}

}  // namespace face::meshik
