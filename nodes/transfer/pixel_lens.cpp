// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/pixel_lens.h"

#include <cmath>
#include <cstddef>

namespace face::transfer {

const std::array<double, lens_window>& lens_weights() {
  static const std::array<double, lens_window> weights = [] {
    std::array<double, lens_window> w{};
    double sum = 0;
    for (int i = 0; i < lens_window; ++i)
      for (int part = 0; part < parts_per_px; ++part) {
        const double apart = (i - 0.5 * (lens_window - 1)) - (part - 0.5 * (parts_per_px - 1));
        w[static_cast<std::size_t>(i)] += std::exp(-0.5 * std::pow(apart / (parts_per_px * lens_px), 2));
      }
    for (const double v : w) sum += v;
    for (double& v : w) v /= sum;
    return w;
  }();
  return weights;
}

}  // namespace face::transfer
