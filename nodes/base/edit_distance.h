// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string_view>

namespace face {

// Letters to put in, take out or change to make b of a (Levenshtein, Binary Codes Capable of Correcting Deletions,
// Insertions, and Reversals, 1966).
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace face
