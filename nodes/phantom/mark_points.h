// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/types/landmarks.h"

namespace face::phantom {

struct MarkPointsOptions {
  std::vector<std::string> names = {"17", "26", "30", "31", "35", "36", "39", "42",
                                    "45", "48", "51", "54", "57", "62", "66", "08"};
  double error_px = 1;  // standard deviation, each of x and y
  std::int64_t seed = 1;
};

// Points as a hand places them in a picture: of the exact ones those with these names that the camera sees, each a
// little off. id: the picture's, where one node marks many (seq.ids). Throws where a name is not among the points.
Landmarks mark_points(const Landmarks& exact, const std::string* id, const MarkPointsOptions& options = {});

}  // namespace face::phantom
