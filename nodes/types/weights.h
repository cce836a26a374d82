// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

namespace face {

// Blend-shape weights of one frame, in the order of a rig's shapes (the ARKit-52 first; a shorter list leaves the rest
// 0).
struct Weights {
  std::vector<float> values;
};

}  // namespace face
