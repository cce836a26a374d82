// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/phantom/vector3.h"

namespace face::phantom {

// Moves what is about a place: by * exp(-|(p - at) / radius|^2). Lengths in mm, in the frame of make_head.
struct Push {
  Vector3 at, radius, by;
};

// What a mode does besides its pushes, at one standard deviation.
struct Feature {
  double upper_lip_mm = 0, lower_lip_mm = 0;  // height of the red
  double cupid_bow_mm = 0;                    // depth of the notch in the upper lip
  double eye_scale = 0;                       // of the opening and the eyeball
  double eye_tilt_deg = 0;                    // outer corners up
  double upper_lid_mm = 0;                    // the upper lid's edge, up
  double ear_scale = 0, ear_stand_deg = 0, ear_tilt_deg = 0, ear_rise_mm = 0;
};

enum class Side {
  both,      // the same left and right
  opposite,  // on the right with the opposite sign
  single     // where it stands
};

struct IdentityMode {
  const char* name;
  Side side = Side::both;
  std::vector<Push> pushes;
  Feature feature = {};
};

// The modes of the embedded head, symmetric ones first.
std::vector<IdentityMode> identity_table();

}  // namespace face::phantom
