// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "nodes/base/quantile.h"

namespace face::model {

inline constexpr double least_noise = 0.02;  // of a pixel, as a share of the scale: no model is better

inline constexpr double usual_kernel = 2.5;  // width of the kernel below, over the noise

// Root weights of pixel residuals (three per point), one per point: Geman and McClure's kernel at the noise of this
// very set, the median length of a residual, or least_noise where that is more. median: that length.
inline std::vector<float> robust_weights(const std::vector<float>& residual, double kernel, double& median) {
  std::vector<float> lengths(residual.size() / 3);
  for (std::size_t i = 0; i < lengths.size(); ++i)
    lengths[i] = std::sqrt((residual[3 * i] * residual[3 * i] + residual[3 * i + 1] * residual[3 * i + 1] +
                            residual[3 * i + 2] * residual[3 * i + 2]) /
                           3.0f);
  median = static_cast<double>(face::median(lengths));
  const auto scale = static_cast<float>(kernel * std::max(least_noise, median));
  for (float& length : lengths) {
    const float u = length / scale;
    length = 1.0f / (1.0f + u * u);
  }
  return lengths;
}

// Root mean square of the better four fifths of the points: hair over the forehead and highlights are no failure. 1
// where there is no point.
inline double trimmed_rms(const std::vector<float>& residual) {
  std::vector<double> squares(residual.size() / 3);
  for (std::size_t i = 0; i < squares.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      squares[i] += static_cast<double>(residual[3 * i + c]) * residual[3 * i + c] / 3.0;
  if (squares.empty()) return 1.0;
  std::sort(squares.begin(), squares.end());
  squares.resize(std::max<std::size_t>(1, squares.size() * 4 / 5));
  double sum = 0;
  for (const double s : squares) sum += s;
  return std::sqrt(sum / static_cast<double>(squares.size()));
}

}  // namespace face::model
