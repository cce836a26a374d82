// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/choose_reference.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"

namespace face::align {

ChooseReferenceResult choose_reference(const engine::Seq<DepthScan>& scans, const engine::Seq<Landmarks>& markers,
                                       const engine::Seq<Image>& interiors, const ChooseReferenceOptions& options) {
  check(!scans.empty(), "scans is empty, expected at least one frame");
  check(scans.size() == markers.size() && scans.size() == interiors.size(), "scans has ", scans.size(),
        " frames, markers ", markers.size(), ", interiors ", interiors.size());
  const std::size_t count = scans.size();
  std::size_t chosen = count;
  if (!options.frame.empty()) {
    for (std::size_t t = 0; t < count && chosen == count; ++t)
      if (scans.id(t) == options.frame) chosen = t;
    check(chosen < count, "frame is \"", options.frame, "\", which no scan has; the first is \"", scans.id(0),
          "\", the last \"", scans.id(count - 1), "\"");
  } else {
    std::vector<double> areas, sorted;
    std::vector<std::size_t> seen;
    for (std::size_t t = 0; t < count; ++t) {
      const auto interior = interiors.at(t);
      areas.push_back(static_cast<double>(std::count(interior->pixels.begin(), interior->pixels.end(), 255)));
      const auto points = markers.at(t);
      seen.push_back(static_cast<std::size_t>(
          std::count_if(points->points.begin(), points->points.end(), [](const Landmark& p) { return p.valid; })));
    }
    sorted = areas;
    std::sort(sorted.begin(), sorted.end());
    const double wanted = options.openness * sorted[(sorted.size() - 1) * 95 / 100];
    const std::size_t most = *std::max_element(seen.begin(), seen.end());
    for (std::size_t t = 0; t < count; ++t)
      if (10 * seen[t] >= 9 * most &&
          (chosen == count || std::fabs(areas[t] - wanted) < std::fabs(areas[chosen] - wanted)))
        chosen = t;
  }
  return {*scans.at(chosen), *markers.at(chosen), *interiors.at(chosen), scans.id(chosen)};
}

}  // namespace face::align
