// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/morphable_model.h"

namespace face::texture {

// How much of the light about a head comes into its nostrils: of every vertex, 1 outside of them. What a picture does
// not show of a nostril was filled in with the skin beside it, and shone in another mouth's picture.
// model: with 68 landmarks, or all is 1.
std::vector<float> nostril_shade(const MorphableModel& model);

}  // namespace face::texture
