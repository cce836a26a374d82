// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/robust_flow.h"

#include <numbers>

#include "nodes/flow/dense_flow.h"
#include "nodes/flow/despike.h"

namespace face::flow {
namespace {

std::vector<Level> levels_of(const FeatureMap& map, const RobustFlowOptions& options) {
  if (!options.remove_spikes) return pyramid_of(map, static_cast<int>(options.levels));
  FeatureMap clean = map;
  const Level level = level_of(map);
  const std::size_t count = level.share.values.size();
  for (std::size_t c = 0; c < map.names.size(); ++c) {
    Plane plane = level.channels[c];
    despike(plane, static_cast<float>(4 * options.data_scale));
    std::copy(plane.values.begin(), plane.values.end(), clean.values.begin() + static_cast<std::ptrdiff_t>(c * count));
  }
  return pyramid_of(clean, static_cast<int>(options.levels));
}

}  // namespace

FlowField robust_flow(const FeatureMap& reference, const FeatureMap& target, const FlowField* start,
                      const RobustFlowOptions& options) {
  check_pair(reference, target, start);
  const std::vector<Level> a = levels_of(reference, options), b = levels_of(target, options);
  DenseFlowOptions dense;
  dense.coarse_warps = static_cast<int>(options.coarse_warps);
  dense.fine_warps = static_cast<int>(options.fine_warps);
  dense.window_radius_px = 0;
  dense.smoothness = static_cast<float>(options.smoothness);
  dense.first_looseness = static_cast<float>(options.first_looseness);
  // The Lorentzian log(1 + x^2 / (2 sigma^2)) halves a weight at sqrt(2) sigma.
  const auto half_at = std::numbers::sqrt2_v<float>;
  dense.bend_px = half_at * static_cast<float>(options.smooth_scale_px);
  dense.weights.assign(reference.names.size(), 1.0f);
  dense.tolerances.assign(reference.names.size(), half_at * static_cast<float>(options.data_scale));
  Plane u, v;
  start_planes(start, reference.width, reference.height, u, v);
  dense_flow(a, b, dense, u, v);
  return field_of(reference, target, u, v);
}

}  // namespace face::flow
