// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace face {

// How the D animation parameters are distributed over the frames of one phone.
struct PhoneStatistic {
  std::string label;               // as in Phone::label; closure and release of a stop are two
  std::int64_t frames = 0;         // that were seen
  std::vector<double> mean;        // D
  std::vector<double> covariance;  // D x D, row by row, symmetric, positive definite
};

// A speaker: one Gaussian per phone, and the one over all speech for phones that were never seen.
struct PhoneStatistics {
  std::vector<PhoneStatistic> phones;  // in the alphabetical order of their labels
  PhoneStatistic all;                  // label ""
};

}  // namespace face
