// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/table.h"

namespace face::evaluate {

struct LandmarksDifferenceResult {
  Table table;
  Image picture;  // a as green dots, b as red rings, without their picture
};

// Points of one picture beside others of the same names: row "all" with rms_px (how far apart they are, over those
// valid in both), largest_px, lost_in_a, lost_in_b (points that the other has, by name and valid); then rms_px =
// distance of every point that moved.
LandmarksDifferenceResult landmarks_difference(const Landmarks& a, const Landmarks& b);

}  // namespace face::evaluate
