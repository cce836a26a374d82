// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/choose_reference.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "nodes/align/upper_difference.h"
#include "nodes/base/check.h"
#include "nodes/base/quantile.h"

namespace face::align {
namespace {

constexpr std::size_t considered = 15;  // frames of about the wanted openness
constexpr std::size_t compared = 25;    // frames of the whole stream, of which blinks are few

// The first of the frames, in this order, that does not look unlike most of the stream.
std::size_t first_usual(const engine::Seq<DepthScan>& scans, const engine::Seq<Landmarks>& markers,
                        const std::vector<std::size_t>& order, double odd) {
  const std::size_t count = std::min(order.size(), considered), others = std::min(scans.size(), compared);
  std::vector<Image> pictures;
  std::vector<std::shared_ptr<const Landmarks>> points;
  for (std::size_t i = 0; i < count; ++i) {
    pictures.push_back(scans.at(order[i])->picture);
    points.push_back(markers.at(order[i]));
  }
  std::vector<std::vector<double>> differences(count);
  for (std::size_t k = 0; k < others; ++k) {
    const std::size_t other = (2 * k + 1) * scans.size() / (2 * others);
    const Image picture = scans.at(other)->picture;
    const std::shared_ptr<const Landmarks> seen = markers.at(other);
    for (std::size_t i = 0; i < count; ++i)
      differences[i].push_back(upper_difference(pictures[i], *points[i], picture, *seen));
  }
  std::vector<double> unlike;
  for (const std::vector<double>& of_frame : differences) unlike.push_back(median(of_frame));
  const double usual = median(unlike);
  for (std::size_t i = 0; i < count; ++i)
    if (unlike[i] <= odd * usual) return order[i];
  return order[0];
}

}  // namespace

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
    std::vector<std::size_t> order;
    for (std::size_t t = 0; t < count; ++t)
      if (10 * seen[t] >= 9 * most) order.push_back(t);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::fabs(areas[a] - wanted) < std::fabs(areas[b] - wanted);
    });
    chosen = options.odd > 0 ? first_usual(scans, markers, order, options.odd) : order[0];
  }
  return {*scans.at(chosen), *markers.at(chosen), *interiors.at(chosen), scans.id(chosen)};
}

}  // namespace face::align
