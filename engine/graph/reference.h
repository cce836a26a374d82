// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "engine/graph/graph.h"

namespace engine {

// [A-Za-z_][A-Za-z0-9_]*: what nodes, ports and parameters are called.
bool is_name(std::string_view text);

// Splits the key of an override: "17-23,40", "take03/17". Returns false, with a sentence in `error`, for anything else.
bool parse_ranges(std::string_view text, std::vector<Override::Range>& ranges, std::string& error);

}  // namespace engine
