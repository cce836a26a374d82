// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/flow/dense_flow.h"

namespace face::flow {

struct RecoverLostOptions {
  DenseFlowOptions dense;         // weights, and how the field found is smoothed
  std::vector<float> mismatches;  // per channel: a difference this large is none of the same place
  std::vector<bool> tells;        // per channel: whether a mismatch says that a pixel is lost
};

// Finds again what a flow has lost, because it moved far or went out of sight: an eyelid that shuts, and the eye below
// it. A reference pixel is lost where most of the 7 x 7 pixels about it differ by a mismatch from where the flow says
// they are. What the target shows in such a place is looked for in the reference (match_labels.h, on the next coarser
// level), not the other way: the lid is in both pictures, the eye in one. That field, smoothed as by dense_flow and
// with its jumps sharpened, is turned round: each triangle of target pixels lies on reference pixels; those under one
// that is stretched over many, across a jump, are hidden and go to its middle, where the edges of what hides them meet.
// Kept where it differs by more than 2 pixels, near lost pixels, and only if clearly fewer of the target's pixels about
// them remain without a match than of the reference's before. reference, target: pyramids; with one level nothing is
// done. start_u, start_v: the displacement about which is looked for, by 24 pixels up and down and 10 sideways; u, v:
// the flow.
void recover_lost(const std::vector<Level>& reference, const std::vector<Level>& target,
                  const RecoverLostOptions& options, const Plane& start_u, const Plane& start_v, Plane& u, Plane& v);

}  // namespace face::flow
