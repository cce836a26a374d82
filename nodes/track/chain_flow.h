// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "engine/port.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/landmarks.h"

namespace face::track {

struct ChainFlowOptions {
  std::vector<std::string> names;  // of the start points that are followed, in this order; none = all of them
  double lean_px = 2.5;
  bool half_size = false;   // flows are of pictures of half the width and height
  double pull = 1;          // share of the difference to the flow from the first frame that is taken back per frame
  double max_pull_px = 20;  // a larger difference says that one of the two has lost the point: nothing is taken back
};

struct ChainFlowResult {
  Landmarks landmarks;   // in the order of `names` or of the start points
  Landmarks home;        // where each of them is on the first frame
  double pulled_px = 0;  // largest difference of the two flows at a point that was pulled
};

// Follows points by stored flows (Speech-Driven 3D Facial Animation, section 3.2: any set of named points, there 48):
// a point goes where the flow from the previous frame takes it, bilinear between its pixels. Differs from the paper: a
// chain drifts (by 10 px and more in 300 frames), so that each point goes, by `pull` of the way per frame, to where the
// flow from the first frame has it, as long as the two agree to max_pull_px.
//
// flow: from the previous frame to this one. from_first: from the first frame to this one, null = chains alone; both of
// face_flow. start: the points on the first frame; the result there is those that `names` has. correction: points of
// this frame that somebody put right, by name; null where there are none. A corrected point goes on from where it was
// put, by the stored flows, to its next correction, and what it was before leaves no trace: its place on the first
// frame is found again from the flow. No other point changes. prior: this function's result for the previous frame. A
// point that leaves the flow's valid pixels is not valid and keeps its last place; the flow from the first frame may
// bring it back.
ChainFlowResult chain_flow(const FlowField& flow, const FlowField* from_first, const Landmarks& start,
                           const Landmarks* correction, const engine::Prior<ChainFlowResult>& prior,
                           const ChainFlowOptions& options = {});

}  // namespace face::track
