// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/flow_field.h"
#include "nodes/types/image.h"

namespace face::render {

// A flow in colours, a pixel per pixel: the hue is the direction (red = right, yellow-green = down, cyan = left, violet
// = up), white stands still and full colour moves as far as the 99th percentile of the lengths, or farther; black = not
// known. The wheel of hues follows Baker et al. (A Database and Evaluation Methodology for Optical Flow, IJCV 2011,
// fig. 4) in its idea; its hues are HSV's.
Image flow_still(const FlowField& flow);

}  // namespace face::render
