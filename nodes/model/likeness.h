// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/model/pixel_rows.h"
#include "nodes/types/morphable_model.h"

namespace face::model {

// What is compared with a picture. The plain face has the fit's shape, the mean person's albedo, light from in front
// and above, and dark eyes: eyes darker than cheeks, lips darker than chin, nose brighter than both, as in every light
// (Sinha, Object Recognition via Image Invariants, 1994, compares such regions). Not the fitted light and albedo: they
// explain a wall as well, and where a picture is dark or full of noise they are what is wrong.
struct LikenessFace {
  const MorphableModel& model;
  const SkinBasis& basis;
  const std::vector<double>& identity;
  const PictureState& state;
  double eyes_px = 0;  // distance of the outer corners of the eyes in the picture
  const std::vector<Vec3f>* colours =
      nullptr;              // of local vertices, where the person's own are known: lit as in `state`
  bool skin_alone = false;  // without what lies between lids and lips
};

// Whether a picture looks like a face where it is said to be: the correlation, -1 to 1, of the picture and of the face
// drawn there, both without what is finer or coarser than eyes, nose and lips, and without what lies between lips,
// which may be teeth; 0 where nothing is seen. Of logarithms, so that a picture's gain and gamma count little; what is
// far beyond its usual contrast is cut off. Below the brows only: hair over the forehead has more edges than all of the
// face. level: of the picture, at about likeness_eyes_px.
double likeness(const LikenessFace& face, const PictureLevel& level);

inline constexpr double likeness_eyes_px = 55;  // distance of the outer corners of the eyes on the level

}  // namespace face::model
