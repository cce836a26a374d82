// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/depth_scan.h"
#include "nodes/types/image.h"

namespace face::mask {

enum class Smoothing { fits, kernels };

struct SmoothDepthOptions {
  Smoothing smoothing = Smoothing::fits;
  std::int64_t window_px = 21;
  std::int64_t highest_degree = 9;
  std::int64_t lowest_degree = 3;
};

// Smooths the depth of a scan along its rows by several passes "of a polynomial kernel of degrees 9 to 3 successively"
// (Bargmann, Blanz and Seidel, section 2). The sentence can be read in two ways, and both are here:
// fits: every pass replaces each depth by the value of a polynomial of that degree fitted to the window about it
// (Savitzky and Golay, Smoothing and Differentiation of Data by Simplified Least Squares Procedures, 1964); kernels:
// every pass is a convolution with (1 - u^2)^degree, u from -1 to 1 over the window. A run of measured pixels is
// continued beyond its ends by point reflection; runs shorter than five pixels stay as they are, and windows are cut to
// the run's length. where: an image of the scan's size; white pixels are smoothed (with the others' help), without it
// all.
DepthScan smooth_depth(const DepthScan& scan, const Image* where, const SmoothDepthOptions& options = {});

}  // namespace face::mask
