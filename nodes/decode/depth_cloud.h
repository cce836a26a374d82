// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace face::decode {

// Points in the order in which their file has them, as it has them.
struct Cloud {
  std::vector<std::array<double, 3>> points;        // NaN or all 0 where nothing was measured
  std::vector<std::array<std::uint8_t, 3>> colors;  // as many, or none
  int width = 0;                                    // of an organised cloud, 0 where the file does not say
  int height = 0;
};

// Reads PLY (ASCII or binary little endian; vertices x y z and, where they have them, red green blue; "comment width W"
// and "comment height H", or "obj_info num_cols W" and "obj_info num_rows H", tell its rows) or XYZ (three or six
// numbers per line, "nan" or zeros where nothing was measured), told by the file's first bytes. Colours are of 8 or 16
// bits, or shares of 1. Throws, naming file, line or byte, where it is neither or is cut off.
Cloud read_cloud(const std::string& bytes, const std::string& title);

}  // namespace face::decode
