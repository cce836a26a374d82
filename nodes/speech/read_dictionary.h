// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/port.h"

namespace face::speech {

// Pronunciations of a word in the dictionary's order: phones with blanks between, without stress.
using Pronunciations = std::map<std::string, std::vector<std::string>, std::less<>>;

// The pronunciations of the wanted words (lower case) in a CMU dictionary: lines "word P H O N E S", variants "word(2)
// ...", comments after ";;;" or "#". Words that it lacks are absent. Throws with file and line on what is not a
// dictionary.
Pronunciations read_dictionary(const engine::File& dictionary, const std::set<std::string, std::less<>>& wanted);

}  // namespace face::speech
