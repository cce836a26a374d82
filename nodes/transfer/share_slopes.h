// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/transfer/opening_scene.h"

namespace face::transfer {

// How much more of a pixel the skin covers as a vertex moves, per pixel to the right and down.
struct ShareSlope {
  std::uint32_t vertex;
  Place slope;
};

// Of every pixel of a pose's view, by its index: what the hole's edges sweep as they move, seen through the lens (Li et
// al., Differentiable Monte Carlo Ray Tracing through Edge Sampling, SIGGRAPH Asia 2018, eq. 6, in a plane). The
// drawing's own slopes do not tell it where a slit is narrower than a pixel: there they are those of a peak. An edge
// over other skin covers nothing.
std::vector<std::vector<ShareSlope>> share_slopes(const OpeningSheet& sheet, const OpeningPose& pose,
                                                  const OpeningView& view);

}  // namespace face::transfer
