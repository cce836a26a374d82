// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/to_components.h"

#include "nodes/base/check.h"
#include "nodes/mmm/find_components.h"

namespace face::mmm {

Weights to_components(const Matrix& components, const Weights& parameters) {
  const std::size_t count = component_count(components);
  if (parameters.values.empty()) return {};
  check(parameters.values.size() == components.columns, "there are ", parameters.values.size(),
        " parameters, the components are of ", components.columns);
  Weights numbers;
  for (std::size_t k = 0; k < count; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < components.columns; ++i)
      sum += components.at(1 + k, i) * (static_cast<double>(parameters.values[i]) - components.at(0, i));
    numbers.values.push_back(static_cast<float>(sum));
  }
  return numbers;
}

}  // namespace face::mmm
