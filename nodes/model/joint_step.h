// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/base/random.h"
#include "nodes/model/fit_joint.h"

namespace face::model {

// What a step goes by (Blanz and Vetter, A Morphable Model for the Synthesis of 3D Faces, SIGGRAPH 1999, equation 8:
// E_F by the points, E_I by the picture), and what it may change.
struct StepWeights {
  double points = 1;        // of E_F
  double image = 1;         // of E_I, as a share of the options' image_weight
  bool light_only = false;  // light and mean skin tone move, all else stays
};

// One Gauss-Newton step of all pictures at once, with priors. levels: one per picture. Pixels are drawn by random.
void step_joint(const std::vector<PictureLevel>& levels, const StepWeights& weights, Random& random, Joint& joint);

}  // namespace face::model
