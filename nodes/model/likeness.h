// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

#include "nodes/model/fit_joint.h"

namespace face::model {

// Whether the picture looks like a face where the fit says: the correlation, -1 to 1, of the picture and of a plain
// face drawn at the fitted place, both without what is finer or coarser than eyes, nose and lips; 0 where nothing is
// seen. The plain face has the fit's shape, the mean person's albedo, light from in front and above, and dark eyes and
// mouth: eyes darker than cheeks, lips darker than chin, nose brighter than both, as in every light (Sinha, Object
// Recognition via Image Invariants, 1994, compares such regions). Not the fitted light and albedo: they explain a wall
// as well, and where a picture is dark or full of noise they are what is wrong. Logarithms, so that a picture's gain
// and gamma count little; what is far beyond its usual contrast is cut off. Below the brows only: hair over the
// forehead has more edges than all of the face. level: of picture `index`, at about likeness_eyes_px.
double likeness(const Joint& joint, std::size_t index, const PictureLevel& level);

inline constexpr double likeness_eyes_px = 55;  // distance of the outer corners of the eyes on the level

}  // namespace face::model
