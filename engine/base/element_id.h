// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

namespace engine {

// Ids of a sequence's elements: integers or names. "0017" and "17" are the same id.
// Canonical form: an integer without leading zeros, else the name as it is. Returns empty for what is no id
// ([A-Za-z0-9_-][A-Za-z0-9_.-]*, but not digits-digits: ids come from file names of strangers).
std::string canonical_id(std::string_view text);

bool is_integer_id(std::string_view canonical);

// Order of a sequence: integers by value first, then names by bytes.
bool id_before(std::string_view a, std::string_view b);

}  // namespace engine
