// SPDX-License-Identifier: Apache-2.0
#include "cli/number_difference.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace cli {

using Json = nlohmann::ordered_json;

void NumberDifference::visit(const Json& x, const Json& y, const std::string& at) {
  if (x.is_number() && y.is_number()) {
    ++numbers;
    const double d = std::abs(x.get<double>() - y.get<double>());
    squares += d * d;
    if (d > largest) largest = d, where = at;
  } else if (x.is_object() && y.is_object()) {
    form |= x.size() != y.size();
    for (const auto& [key, value] : x.items())
      if (const auto other = y.find(key); other != y.end())
        visit(value, *other, at + "/" + key);
      else
        form = true;
  } else if (x.is_array() && y.is_array()) {
    form |= x.size() != y.size();
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) visit(x[i], y[i], at + "/" + std::to_string(i));
  } else if (x != y) {
    ++others;
    form |= x.type() != y.type();
  }
}

}  // namespace cli
