// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace face {

// A named point in an image, in pixels; pixel (0, 0) is the centre of the top left one.
struct Landmark {
  std::string name;
  double x_px = 0;
  double y_px = 0;
  bool valid = true;  // false where it was lost: x, y are then a guess, moved with the rest
};

// The points of one frame.
struct Landmarks {
  std::vector<Landmark> points;
};

}  // namespace face
