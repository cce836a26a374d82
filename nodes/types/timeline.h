// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

namespace face {

// When each element of a timed sequence is shown, in the sequence's order.
struct Timeline {
  std::vector<double> time_s;  // start of every frame
  double duration_s = 0;       // end of the last one
};

}  // namespace face
