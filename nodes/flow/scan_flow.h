// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/types/feature_map.h"
#include "nodes/types/flow_field.h"

namespace face::flow {

struct ScanFlowOptions {
  std::int64_t levels = 5;
  std::int64_t coarse_warps = 2;
  std::int64_t fine_warps = 3;
  std::int64_t window_px = 5;
  std::int64_t offset_window_px = 9;
  double radius_weight = 0.05;  // relative to grey
  double smoothness = 3;
  double damping = 0.02;
  double tolerance = 6;  // in units of the channel's gradient scale; 0 = none
  double bend_px = 0.5;  // 0 = none
  bool search = true;
  double mismatch = 0;  // in units of the channel's gradient scale; 0 = what is lost stays lost
};

// Where every pixel of a reference scan is in another: the flow of Bergen and Hingorani (Hierarchical Motion-Based
// Frame Rate Conversion, 1990) on several channels at once, as Bargmann, Blanz and Seidel use it on radius and grey
// value of face scans (Eqs. 2-4): over a 5 x 5 window R the displacement minimises
//   sum_R sum_c weight_c |d I_c/du du + d I_c/dv dv + Delta I_c|^2,
// coarse to fine on a Gaussian pyramid, and after every step a relaxation smooths where contrast is low (Blanz and
// Vetter, A Morphable Model for the Synthesis of 3D Faces, SIGGRAPH 1999): sum_p (w_p - w0_p)' J_p (w_p - w0_p) +
// smoothness * sum_pq |w_p - w_q|^2, where J is the window's mean structure tensor. It is an energy, not a filter: what
// the window determines is kept, in the direction in which it does.
// Differs from the paper: channels are divided by the median length of their gradients, so that mm and grey levels can
// be added; residuals far above it count less; pixels that are not measured count nothing; the local 2 x 2 system is
// damped by its smaller eigenvalue; neighbours that move differently (the lips) are held together less, those across
// what is not measured (the gap between the lips) hardly; residuals are freed of their mean over a window, because a
// jaw that drops changes its radius and its shading; large motions are found by a search for patches on the coarser
// levels (patch_search.h); a 5 x 5 median after every step (Sun, Roth and Black, Secrets of Optical Flow Estimation,
// CVPR 2010); with a mismatch, what is lost all the same is looked for again from the target (recover_lost.h); any
// channel but the radius tells what is lost. reference and target: same size, same channels. start: displacements to
// begin with (a rigid motion), may be absent. A pixel of the result is valid where the reference is measured and the
// target is at the place found.
FlowField scan_flow(const FeatureMap& reference, const FeatureMap& target, const FlowField* start,
                    const ScanFlowOptions& options = {});

}  // namespace face::flow
