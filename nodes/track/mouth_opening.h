// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::track {

// How much of the line from lip_3 to lip_9, in usual widths of a mouth (1.5 times between the inner corners of the
// eyes, or as wide as it is where these are not seen), is no lip: the mean over the line of how far short of the lips'
// own redness it falls (lip_redness.h), times its length. So neither reflexes nor paint nor shade on a lip count, teeth
// and the hollow of a mouth do. What is left of lips that meet, a dark seam and grain, depends on the speaker, the
// light and the camera: compare with other frames (find_contact.h). Where the lips are hardly red, as in a grey film,
// brightness tells, but badly: how far it is from what lips alone would show, brought to the same scale. -1 where a
// point of the line or a corner of the mouth is not valid. Throws where one is missing. colours: what is seen on the
// line (lip_colours.h).
double mouth_opening(const Matrix& colours, const Landmarks& landmarks);

}  // namespace face::track
