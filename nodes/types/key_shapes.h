// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/types/landmarks.h"

namespace face {

// One typical shape of a set of tracked points.
struct KeyShape {
  std::string frame;      // id of the frame that shows it (its exemplar)
  std::int64_t size = 0;  // frames that it stands for
  Landmarks landmarks;
};

// The typical shapes of a performance, largest group first.
struct KeyShapes {
  std::vector<KeyShape> shapes;
};

}  // namespace face
