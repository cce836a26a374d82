// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/declare/node_info.h"
#include "engine/graph/json_tree.h"

namespace engine {

// "an integer from 1 to 10", "one of \"upper\", \"lower\"", "a list of numbers from 0 to 1 px".
std::string expected_value(const ParamInfo& param);

// The parameter's value, or nothing with what was found and expected in `error`.
std::optional<ParamValue> read_param(const JsonValue& value, const ParamInfo& param, std::string& error);

// A value typed on a command line as the JSON that means the same: 6 for an integer, true for a flag, [1, 2] or 1,2 for
// a list. What does not look like the parameter's kind becomes a string, which read_param() refuses.
JsonValue value_of_text(std::string_view text, const ParamInfo& param, const SourceFile& source,
                        const std::string& pointer);

// Bytes of "8GB", "500MB", "1.5 GB", "100000" (decimal units B, kB or KB, MB, GB, TB), or nothing for anything else.
std::optional<std::int64_t> parse_size(std::string_view text);
inline constexpr std::string_view size_examples = "\"500MB\" or \"8GB\" (B, kB, MB, GB, TB)";

}  // namespace engine
