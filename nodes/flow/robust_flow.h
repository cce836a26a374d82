// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/feature_map.h"
#include "nodes/types/flow_field.h"

namespace face::flow {

struct RobustFlowOptions {
  std::int64_t levels = 5;
  std::int64_t coarse_warps = 5;
  std::int64_t fine_warps = 5;
  double smoothness = 100;
  double data_scale = 3;         // sigma of the data term, grey levels or the channel's unit
  double smooth_scale_px = 0.5;  // sigma of the smoothness term
  double first_looseness = 4;
  bool remove_spikes = true;
};

// Dense optical flow with robust data and smoothness terms (Black and Anandan, The Robust Estimation of Multiple
// Motions: Parametric and Piecewise-Smooth Flow Fields, CVIU 1996, Eq. 23):
//   sum_p rho(I_x u + I_y v + I_t, sigma_1) + lambda sum over neighbours rho(|w_p - w_q|, sigma_2),
// rho the Lorentzian, minimised coarse to fine by over-relaxation; at every level both sigmas start larger and shrink
// (graduated non-convexity), so that outliers of brightness and edges of motion are left out step by step.
// Differs from the paper: rho is minimised by reweighted least squares instead of its derivative; neighbours' u and v
// share one weight; the picture is warped several times per level; single wild pixels are replaced before (despike.h),
// because a gradient across one is as wild as its difference. Ports and meaning as in scan_flow.
FlowField robust_flow(const FeatureMap& reference, const FeatureMap& target, const FlowField* start,
                      const RobustFlowOptions& options = {});

}  // namespace face::flow
