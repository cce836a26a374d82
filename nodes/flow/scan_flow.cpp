// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/scan_flow.h"

#include "nodes/base/check.h"
#include "nodes/flow/dense_flow.h"
#include "nodes/flow/recover_lost.h"

namespace face::flow {

FlowField scan_flow(const FeatureMap& reference, const FeatureMap& target, const FlowField* start,
                    const ScanFlowOptions& options) {
  check_pair(reference, target, start);
  check(options.window_px % 2 == 1, "window_px is ", options.window_px, ", expected an odd number");
  const std::vector<Level> a = pyramid_of(reference, static_cast<int>(options.levels));
  const std::vector<Level> b = pyramid_of(target, static_cast<int>(options.levels));
  DenseFlowOptions dense;
  dense.coarse_warps = static_cast<int>(options.coarse_warps);
  dense.fine_warps = static_cast<int>(options.fine_warps);
  dense.window_radius_px = static_cast<int>(options.window_px / 2);
  dense.offset_radius_px = static_cast<int>(options.offset_window_px / 2);
  dense.smoothness = static_cast<float>(options.smoothness);
  dense.damping = static_cast<float>(options.damping);
  dense.bend_px = static_cast<float>(options.bend_px);
  dense.unmeasured_link = 0.02f;
  dense.first_looseness = 3;
  dense.search = options.search;
  dense.median = true;
  dense.between = Between::cubic;  // bilinear reading blurs the target alone: dots are found 2 % too large
  std::vector<float> scales;
  for (std::size_t c = 0; c < reference.names.size(); ++c) {
    const float scale = scales.emplace_back(gradient_scale(a[0].channels[c], a[0].share));
    const float weight = reference.names[c] == "radius" ? static_cast<float>(options.radius_weight) : 1.0f;
    dense.weights.push_back(weight / (scale * scale));
    dense.tolerances.push_back(static_cast<float>(options.tolerance) * scale);
  }
  Plane u, v;
  start_planes(start, reference.width, reference.height, u, v);
  const Plane first_u = u, first_v = v;
  dense_flow(a, b, dense, u, v);
  if (options.mismatch > 0) {
    RecoverLostOptions recover{dense, {}, {}};
    for (std::size_t c = 0; c < reference.names.size(); ++c) {
      recover.mismatches.push_back(static_cast<float>(options.mismatch) * scales[c]);
      recover.tells.push_back(reference.names[c] != "radius");  // a jaw that drops changes its radius
    }
    recover_lost(a, b, recover, first_u, first_v, u, v);
  }
  return field_of(reference, target, u, v);
}

}  // namespace face::flow
