// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace face {

// A picture of measurements of any kind, as dense correspondence compares them: "radius" (mm) and "grey" (0 to 255) of a
// scan, "grey" or "red", "green", "blue" of an image. Rows from the top; pixel (0, 0) is a centre.
struct FeatureMap {
  int width = 0;
  int height = 0;
  std::vector<std::string> names;   // C, one per channel
  std::vector<float> values;        // C x height x width, one channel after the other
  std::vector<std::uint8_t> valid;  // height x width, 1 where all channels are measured, else 0
};

}  // namespace face
