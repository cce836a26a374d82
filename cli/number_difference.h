// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace cli {

// How two JSON forms differ, number by number.
struct NumberDifference {
  std::size_t numbers = 0, others = 0;  // compared; of the rest, those that differ
  double largest = 0, squares = 0;
  std::string where;  // of the largest, as a JSON pointer
  bool form = false;  // they are not made alike: lengths or keys differ

  // at: where x and y stand.
  void visit(const nlohmann::ordered_json& x, const nlohmann::ordered_json& y, const std::string& at);
};

}  // namespace cli
