// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "nodes/model/pixel_rows.h"
#include "nodes/model/robust_weights.h"

namespace face::model {

// The robust normal equations of pixel residuals: J' W J and -J' W r, W Geman and McClure's weights at the residuals'
// own noise. Without the rows' joint weight. kernel: its width over the noise.
struct PixelNormal {
  std::vector<double> a;  // columns x columns
  std::vector<double> b;  // columns
  double median = 0;      // length of a residual
  double noise = 0;       // the same, at least least_noise
  double points = 0;
};
PixelNormal pixel_normal(const PixelRows& rows, double kernel = usual_kernel);

}  // namespace face::model
