// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/matrix.h"

namespace face::trajectory {

struct GaussianPathOptions {
  double smoothness = 10;  // lambda of the paper
};

// The smoothest path through one Gaussian per frame and dimension (Animating Lip-Sync Speech Faces, Eqs 6 and 7, D =
// identity): minimises sum_tk (x - mean)^2 / variance + smoothness sum_tk (x_t - x_(t-1))^2 exactly. means, variances:
// T x K, variances > 0; infinity leaves a value free. Returns T x K.
Matrix gaussian_path(const Matrix& means, const Matrix& variances, const GaussianPathOptions& options = {});

}  // namespace face::trajectory
