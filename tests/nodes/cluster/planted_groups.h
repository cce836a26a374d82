// SPDX-License-Identifier: Apache-2.0
// Points in groups whose sizes differ a hundredfold.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/random.h"
#include "nodes/types/matrix.h"

namespace test {

struct PlantedGroups {
  face::Matrix points;
  std::vector<std::size_t> group;    // of every point
  std::vector<std::size_t> centres;  // the point in the middle of every group
};

// Group g has a share of points that falls by a fifth from group to group. Groups lie apart: their middles have a
// standard deviation of 10 per coordinate, the points about them one of `noise`. The middle itself is a point.
inline PlantedGroups planted_groups(std::size_t count, std::size_t dims, std::size_t groups, double noise = 1) {
  PlantedGroups planted{{count, dims, std::vector<double>(count * dims)}, {}, {}};
  face::Random random(11);
  std::vector<double> middles(groups * dims), upto(groups);
  for (double& value : middles) value = 10 * random.normal();
  double sum = 0;
  for (std::size_t g = 0; g < groups; ++g) upto[g] = sum += std::pow(0.8, static_cast<double>(g));
  for (std::size_t i = 0; i < count; ++i) {
    const bool middle = i < groups;
    const double draw = random.uniform() * sum;
    const auto drawn = static_cast<std::size_t>(std::upper_bound(upto.begin(), upto.end(), draw) - upto.begin());
    const std::size_t g = middle ? i : std::min(groups - 1, drawn);
    planted.group.push_back(g);
    if (middle) planted.centres.push_back(i);
    for (std::size_t d = 0; d < dims; ++d)
      planted.points.at(i, d) = middles[g * dims + d] + (middle ? 0 : noise * random.normal());
  }
  return planted;
}

}  // namespace test
