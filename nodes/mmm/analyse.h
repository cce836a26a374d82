// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/image.h"
#include "nodes/types/mmm.h"
#include "nodes/types/weights.h"

namespace face::mmm {

struct AnalyseOptions {
  double restraint = 1e-3;  // pulls alpha to 0, as a share of the flows' mean square
  bool sum_to_one = true;
  std::int64_t stride_px = 2;  // every n-th pixel and row counts
};

struct AnalyseResult {
  Weights parameters;  // 2 N: alpha, then beta
  double rms = 0;      // of what is left of the picture, grey levels
};

// Where a picture lies in the space of a model (Ezzat et al. 2002, section 4.5): alpha from the flow of the reference
// to the picture, |C - sum alpha_i C_i|^2; then, with every prototype brought to that shape, beta >= 0 from
// |I - sum beta_i I_i'|^2 (nodes/base/nnls.h).
// Differs from the paper: alpha is held near 0 where flows resemble each other, and so is that of the reference, whose
// flow is 0. sum_to_one: the beta of a picture sum to 1, and so do those of every mean of pictures.
// Throws where the picture's size is not the model's, or the model has more than 63 prototypes.
AnalyseResult analyse(const Mmm& model, const Image& image, const AnalyseOptions& options = {});

}  // namespace face::mmm
