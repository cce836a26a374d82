// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/matrix.h"

namespace face::mmm {

struct RefinePerspectiveOptions {
  std::int64_t max_rounds = 12;
  double least_scale_levels = 1;  // grey levels that count as noise even where the pictures are more alike
};

// A perspective that is nearly right, made right by the pictures themselves: all pixels of the mask at once, at full
// size, Gauss-Newton steps on the eight parameters of |frame(H x) - reference(x)|^2 with weights that fall with the
// residual (Lucas and Kanade, An Iterative Image Registration Technique, IJCAI 1981; steps are composed with H as in
// Baker and Matthews, Lucas-Kanade 20 Years On, IJCV 2004, section 3.1). What flow finds where there is little to see
// is smoothness, not measurement, and pulls at a plane fitted to it; here such pixels say nothing. Both pictures are
// smoothed by a binomial of 3 x 3 first, and gradients are means of both.
// reference, frame, mask: of one size; mask: pixels of at least 128 count, null = all. start: 3 x 3. Where the pictures
// tell nothing, or steps lead away by more than 8 px at a corner, the result is the start.
Matrix refine_perspective(const Image& reference, const Image& frame, const Image* mask, const Matrix& start,
                          const RefinePerspectiveOptions& options = {});

}  // namespace face::mmm
