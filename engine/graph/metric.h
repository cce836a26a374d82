// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "engine/graph/graph.h"

namespace engine {

// A number in a graph's results: "score.median_mm", "score.errors[17]", or, with a path into the value's JSON form (the
// one that `facegraph get` prints), "score.table/rows/lips/values/0".
struct Metric {
  Reference reference;
  std::vector<std::string> path;
};
// Returns false, with a sentence in `error`, for what is none. A path needs the output's name before it.
bool parse_metric(std::string_view text, Metric& metric, std::string& error);

// The number (true is 1, false 0) that a path leads to in a JSON text. A step is the key of an object, the position in
// a list, or the "name" of one of a list's objects. Throws std::invalid_argument that says where the path ends, and
// what is there.
double number_at(const std::string& json, const std::vector<std::string>& path);

}  // namespace engine
