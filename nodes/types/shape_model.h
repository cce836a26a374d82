// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

namespace face {

// A linear space of shapes, of V points in 3D: shape = mean + sum_k coefficient_k * mode k, found by (region-weighted)
// principal component analysis. Modes need not be orthogonal; a shape's coefficients are coefficient_k =
// projection k . (shape - mean).
struct ShapeModel {
  std::size_t vertices = 0;         // V
  std::vector<double> mean_mm;      // V x 3
  std::vector<double> sigmas_mm;    // K, falling: standard deviation of each coefficient over the examples
  std::vector<double> modes;        // K x V x 3
  std::vector<double> projections;  // K x V x 3

  std::size_t size() const { return sigmas_mm.size(); }
};

}  // namespace face
