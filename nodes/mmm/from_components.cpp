// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/from_components.h"

#include "nodes/base/check.h"
#include "nodes/mmm/find_components.h"

namespace face::mmm {

Weights from_components(const Matrix& components, const Weights& numbers) {
  const std::size_t count = component_count(components);
  if (numbers.values.empty()) return {};
  check(numbers.values.size() == count, "there are ", numbers.values.size(), " numbers, expected ", count);
  Weights parameters;
  for (std::size_t i = 0; i < components.columns; ++i) {
    double sum = components.at(0, i);
    for (std::size_t k = 0; k < count; ++k)
      sum += components.at(1 + count + k, i) * static_cast<double>(numbers.values[k]);
    parameters.values.push_back(static_cast<float>(sum));
  }
  return parameters;
}

}  // namespace face::mmm
