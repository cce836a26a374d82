// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/types/landmarks.h"
#include "nodes/types/rig.h"

namespace face::meshik {

struct LandmarkVertex {
  std::size_t landmark = 0;  // index into the landmarks
  std::uint32_t vertex = 0;
  int number = 0;  // of Multi-PIE's 68
  bool rigid = false;  // moves with the skull alone
};

// The rig's vertices at the landmarks of the 18-point layout (lip_0 to lip_11 from the right corner of the mouth over
// the upper lip, jaw_r, chin, jaw_l, eye_inner_r, eye_inner_l, nose_tip), which are points 48 to 59, 7
// to 9, 39, 42 and 30 of its 68, and of inner_lip_0 to inner_lip_7, which are 60 to 67; or at those that are named by
// their number, "00" to "67". Landmarks of other names are left out. Throws where the rig has no landmarks or no
// landmark of the layout is there.
std::vector<LandmarkVertex> landmark_vertices(const Rig& rig, const Landmarks& landmarks);

// How large a pixel is on the rig, mm: the scale at which the landmarks of a face at rest, seen from the front, lie
// nearest to the rig's (least squares about their means). Throws where they do not lie as those of an upright face do.
double landmark_scale_mm(const Rig& rig, const Landmarks& neutral, const std::vector<LandmarkVertex>& places);

}  // namespace face::meshik
