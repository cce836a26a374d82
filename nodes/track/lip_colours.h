// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::track {

struct LipColoursResult {
  Matrix colours;   // 192 x 3: 64 places on each of three lines across the mouth, from above; as FaceColours::at
  Matrix contrast;  // 1 x 3: how much contrast the face has in each colour (face_contrast.h)
};

// All that inner_lips.h and mouth_opening.h look at, so that they need no picture, however often they look: the colours
// on three lines across the mouth, from a point of the outer upper lip to the one below it (lip_2 to lip_10, lip_3 to
// lip_9, lip_4 to lip_8), each the mean over a short stretch along the mouth. Throws where a point of a line or a
// corner of the mouth is missing. light: takes the picture back to the light of the film's first frame (track_klt.h);
// null = it is the same.
LipColoursResult lip_colours(const Image& image, const Landmarks& landmarks, const Matrix* light = nullptr);

}  // namespace face::track
