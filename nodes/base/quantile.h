// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace face {

// The middle value in rank, of an even number the upper one: always one of the values. 0 for an empty list.
template <class T>
T median(std::vector<T> values) {
  if (values.empty()) return T{};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Between the two neighbours in rank, linearly (type 7 of Hyndman and Fan, Sample Quantiles in Statistical Packages,
// The American Statistician 50, 1996, as numpy). share in [0, 1]. NaN for an empty list: nothing was measured.
double quantile(std::vector<double> values, double share);

}  // namespace face
