// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

namespace face {

// A mono recording. Samples are in [-1, 1].
struct Audio {
  double rate_hz = 16000;
  std::vector<float> samples;

  double duration_s() const { return static_cast<double>(samples.size()) / rate_hz; }
};

}  // namespace face
