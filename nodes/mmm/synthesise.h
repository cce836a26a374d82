// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/mmm.h"
#include "nodes/types/weights.h"

namespace face::mmm {

struct SynthesiseOptions {
  double most_gain = 2;  // of detail that the mean of prototypes has lost, see keep_detail; 1 = the mean as it is
};

// The picture at a place in the space of a model (Ezzat et al. 2002, section 4.4): flows mixed by alpha, prototypes
// brought to that shape and mixed by beta. parameters: 2 N, alpha then beta.
// Differs from the paper: a beta below 0, to which the smooth path of a sentence may swing, counts as 0, and the others
// keep the sum; and detail is as strong as in the prototypes (keep_detail), which a mean of them blurs.
Image synthesise(const Mmm& model, const Weights& parameters, const SynthesiseOptions& options = {});

}  // namespace face::mmm
