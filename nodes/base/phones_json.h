// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

#include "nodes/types/phones.h"

namespace face {

// [{"phone": "AA", "start_s": 0.77, "end_s": 0.91, "word": "john", "score": -0.1}, ...], one phone per line. "word" and
// "score" are left out where they say nothing. Times are written so that reading gives them back exactly.
std::string write_phones_json(const Phones& phones);

// Reads it back; "word" and "score" may be missing. The duration is the end of the last phone. Labels and times are
// taken as they stand. name: what messages call the file. Throws with name, place, what was found and what was
// expected.
Phones parse_phones_json(std::string_view text, const std::string& name);

}  // namespace face
