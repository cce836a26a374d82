// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/track/patch.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::track {

// A small grey picture of the box about the points: 40 pixels wide, or as wide as the box where that is less. Empty
// where there are fewer than two points or the box has no width.
Image learn_face(const Grey& grey, const Landmarks& points);

struct FaceMatch {
  double dx_px = 0;  // from where the points were learnt
  double dy_px = 0;
  double likeness = -1;  // zero-mean normalised cross-correlation of the best place
};

// Looks for the picture of learn_face(_, points) anywhere in a frame, as large and as upright as it was.
FaceMatch find_face(const Grey& grey, const Landmarks& points, const Image& face);

// Deviation of a picture's grey values.
double spread_of(const Grey& grey);

// Nothing can be seen in a frame without contrast: black, white or a fade's end. Deviation below 3 grey levels.
bool is_even(const Grey& grey);

// Two frames that show different things: correlation below 0.5. Frames of unequal size or without contrast do, too.
bool is_cut(const Grey& before, const Grey& now);

}  // namespace face::track
