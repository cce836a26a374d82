// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace face::exports {

// The bytes of a grey PNG of 16 bits. values: height x width. The same values always give the same bytes.
std::string encode_png16(const std::vector<std::uint16_t>& values, int width, int height);

}  // namespace face::exports
