// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "nodes/track/settle.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::track {

// What the edge of the lips looks like where somebody placed it. Row 0: lipness of a colour = a log((R+8)/(G+8)) + b
// log((B+8)/(G+8)) + c luma/255 + d, which is 1 on lips and 0 on the skin around them (Fisher's discriminant of both),
// and how far the seam between the lips lies from each corner, px; then a row per point of the outline: lipness along
// the normal from inside to outside, a pixel apart; at the corners the darkness of the seam between the lips along the
// mouth's width.
Matrix learn_outline(const Image& image, const Landmarks& points, const std::vector<std::size_t>& outline);

// Where the edge of the lips was seen, one entry per point of the outline.
struct EdgeSight {
  std::vector<Sighting> sightings;  // sure across the edge only; at the corners both ways
  std::vector<double> likeness;     // 0 to 1: how much what is there looks like what was learnt
};

// Looks for the edge near the expected points, along the normals: profiles as learnt (Cootes, Taylor, Cooper, Graham:
// Active Shape Models, CVIU 1995; differs from it: the profile of a colour's lipness instead of a
// normalised derivative of grey, from one image). The corners are where the dark seam between the lips ends as it did
// when it was learnt, however dark it is (after Eveno, Caplier, Coulon: Accurate and Quasi-Automatic Lip Tracking, IEEE
// TCSVT 2004, who follow the luminance minima), not too far from where the head alone would put them:
// `rest`. reach_px: how far from the expected points; the corners twice as far.
EdgeSight see_outline(const Image& image, const Landmarks& expected, const Landmarks& rest,
                      const std::vector<std::size_t>& outline, const Matrix& look, double reach_px);

}  // namespace face::track
