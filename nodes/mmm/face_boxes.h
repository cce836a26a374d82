// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/landmarks.h"

namespace face::mmm {

// A part of a picture, px.
struct FaceBox {
  double left = 0, top = 0, right = 0, bottom = 0;
  bool holds(double x, double y) const { return x >= left && x <= right && y >= top && y <= bottom; }
};

// Parts of a face that is seen from the front and stands upright.
struct FaceBoxes {
  FaceBox head;        // an ellipse fills it
  FaceBox eyes;        // both, with the brows
  FaceBox mouth;       // everything below the nose, which the jaw moves
  FaceBox lower_face;  // from the nose to below a wide open mouth's chin, with the outline beside it: whole pixels
};

// Finds them by the 68 points of Multi-PIE ("0" or "00" to "67"), or by six of those that a clip is tracked with:
// eye_inner_r, eye_inner_l, nose_tip, lip_0, lip_6 (the corners of the mouth) and chin. With the six, sizes are those of
// a mean adult as multiples of the distance of the inner corners of the eyes (Farkas, Anthropometry of the Head and
// Face, 1994: 32 mm; the face 137 mm wide, the hair line 70 mm above the eyes). lower_face is cut to the picture.
// Throws where points are missing.
FaceBoxes find_face_boxes(const Landmarks& landmarks, int width_px, int height_px);

}  // namespace face::mmm
