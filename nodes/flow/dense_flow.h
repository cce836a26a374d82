// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/flow/plane.h"

namespace face::flow {

// What scan_flow and robust_flow have in common: coarse to fine, on every level a few times: warp the target,
// linearise, sum the structure tensor over a window, smooth by lowering an energy.
struct DenseFlowOptions {
  int coarse_warps = 4;               // linearisations on every level but the finest
  int fine_warps = 2;                 // on the finest
  int window_radius_px = 2;           // the tensor is a mean over (2 radius + 1)^2 pixels
  int sweeps = 15;                    // of the relaxation per linearisation
  float smoothness = 0.1f;            // of the links
  float damping = 0;                  // lambda_min at which a local solution is halved; 0 = none
  std::vector<float> weights;         // per channel, of its squared residual
  std::vector<float> tolerances;      // per channel: a residual this large counts half; 0 = all count fully
  float first_looseness = 1;          // tolerances and bend start so many times larger and shrink
  float bend_px = 0;                  // a difference between neighbours this large counts half; 0 = quadratic
  float unmeasured_link = 1;          // factor of links to pixels where the reference is not measured
  bool median = false;                // 5 x 5 median of the field after every linearisation
  Between between = Between::linear;  // how the target is read
  bool search = false;                // on every level but the finest, patches are searched first: large motions
  int offset_radius_px = 0;           // residuals are freed of their mean over this window: light, jaw turned; 0 = no
};

// Improves u, v (the start) at the size of reference[0]. reference, target: pyramids of as many levels and channels.
void dense_flow(const std::vector<Level>& reference, const std::vector<Level>& target, const DenseFlowOptions& options,
                Plane& u, Plane& v);

// Median of the gradient's length over measured pixels with measured neighbours, of those where it is not 0 (a flat
// background says nothing about noise); 1 where there is none.
float gradient_scale(const Plane& channel, const Plane& share);

}  // namespace face::flow
