// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/depth_scan.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/landmarks.h"

namespace face::flow {

struct StartFlowOptions {
  double reach_px = 25;
};

// Displacements to begin a flow with, from what is known before: every measured point of the reference is seen through
// the target's camera (after rigid alignment this is the head's motion), and markers seen in both bend it: what they
// have moved beyond it is spread about them as a Gaussian-weighted mean (Shepard, A Two-Dimensional Interpolation
// Function for Irregularly-Spaced Data, 1968, with Gaussian weights of width reach_px, falling to the rigid motion far
// from all). reference, target: scans of one world. Markers are matched by name; those of one frame alone, or not
// valid, do not count. Valid where the reference is measured.
FlowField start_flow(const DepthScan& reference, const DepthScan& target, const Landmarks* reference_markers,
                     const Landmarks* target_markers, const StartFlowOptions& options = {});

}  // namespace face::flow
