// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::track {

struct FaceFlowOptions {
  bool half_size = false;   // of pictures of half the width and height; pixels are then those
  double margin = 0.35;     // about the box of the points, as a share of its larger side
  std::int64_t levels = 5;  // of flow.robust
  std::int64_t coarse_warps = 3;
  std::int64_t fine_warps = 3;
};

// Robust optical flow (flow::robust_flow) of the part of a picture that shows a face, to be kept: chain_flow follows
// points by it, and again when somebody has put a point right (Speech-Driven 3D Facial Animation, section 3.2). From
// the previous frame to this one; from `reference` to this one where it is given. frames: window 1, 0. start: points
// whose box, with the margin, is looked at. At the first frame without a reference the flow is 0.
// Differs from the paper: only the face is looked at, and displacements are rounded to 1/64 px, which packs them to a
// third. Pixels outside the box are not valid.
FlowField face_flow(const engine::Window<Image>& frames, const Landmarks& start, const Image* reference,
                    const FaceFlowOptions& options = {});

}  // namespace face::track
