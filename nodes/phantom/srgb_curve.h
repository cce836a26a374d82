// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "nodes/base/srgb.h"

namespace face::phantom {

// Light to sRGB as a number, by a table over its square root, where the curve is nearly straight.
class SrgbCurve {
 public:
  SrgbCurve() {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const double root = static_cast<double>(i) / steps, light = root * root;
      values_[i] = static_cast<float>(srgb_of(light));
    }
  }
  float operator()(float light) const {
    const float position = std::sqrt(std::clamp(light, 0.0f, 2.0f)) * steps;
    const auto index = static_cast<std::size_t>(position);
    return values_[index] + (position - static_cast<float>(index)) * (values_[index + 1] - values_[index]);
  }

 private:
  static constexpr int steps = 512;
  std::array<float, 727> values_{};  // up to a root of 1.418: light of 2 is out of the picture anyway
};

}  // namespace face::phantom
