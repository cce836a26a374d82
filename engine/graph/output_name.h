// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

namespace engine {

// Why a text cannot be the file name of an output, or empty. Outputs never leave their folder.
std::string output_name_error(std::string_view name);

// The text in small letters (ASCII).
std::string folded(std::string_view text);

}  // namespace engine
