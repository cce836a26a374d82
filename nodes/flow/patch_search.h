// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/flow/plane.h"

namespace face::flow {

struct PatchSearchOptions {
  int stride_px = 4;           // between patches of 8 x 8 pixels
  int iterations = 12;         // at most, per candidate
  std::vector<float> weights;  // per channel, of its squared difference
};

// Finds large motions on one pyramid level: patches of 8 x 8 pixels, freed of their mean, are moved by inverse
// Gauss-Newton steps from several starts (the field so far, an alternative field, the patches beside and above, and in
// a second pass below), the best is kept, and the field becomes the mean of the patches over each pixel, weighted by
// how well they fit there (Kroeger, Timofte, Dai, Van Gool, Fast Optical Flow using Dense Inverse Search, ECCV 2016,
// section 2). Differs from the paper: several channels, pixels that are not measured do not count, patches in a fixed
// order, so that the result does not depend on threads. u, v: the field so far; also_u, also_v: another start.
void search_patches(const Level& reference, const Level& target, const PatchSearchOptions& options, const Plane& also_u,
                    const Plane& also_v, Plane& u, Plane& v);

}  // namespace face::flow
