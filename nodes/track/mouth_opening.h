// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::track {

// How much of what lies between the outer edges of the lips, in the middle of the mouth, is unlike the lips: the mean
// distance of its colours from what lips alone would show (the colours at either end of the line from lip_3 to lip_9,
// the one turning evenly into the other), times the length of the line in usual widths of a mouth: 1.5 times between
// the inner corners of the eyes, or as wide as it is where these are not seen. Teeth, tongue and the hollow of a mouth
// add to it, and so, but little, do the dark seam and the grain of lips that meet; how much that is depends on the
// speaker, the light and the camera: compare with other frames (find_contact.h). Brightness counts as a share of the
// lips', so that the light does not; blue to green counts least, as films keep it coarsest. -1 where a point of the
// line or a corner of the mouth is not valid. Throws where one is missing.
// light: takes the picture back to the light of the film's first frame (track_klt.h); null = it is the same.
double mouth_opening(const Image& image, const Landmarks& landmarks, const Matrix* light = nullptr);

}  // namespace face::track
