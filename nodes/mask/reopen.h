// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/depth_scan.h"
#include "nodes/types/image.h"

namespace face::mask {

// Takes the depth out again where an image is white: the mouth, closed by filling and smoothing, is an opening once
// more, whose edges were smoothed with the surface across it. interior: grey, of the scan's size.
DepthScan reopen(const DepthScan& scan, const Image& interior);

}  // namespace face::mask
