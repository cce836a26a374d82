// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/face_fit.h"
#include "nodes/types/image.h"

namespace face::texture {

struct ContinueBackgroundOptions {
  double stripe_mm = 15;   // width beside the face's contour, as in the paper
  double margin_mm = 1.5;  // by which the mask is widened first: a fit is never exact
};

// What might be behind the rim of a face: the stripe outside its contour, reflected to the inside. A pixel at distance
// d inside takes the colour at itself - 2 d g with the unit gradient g of the distance (Blanz et al., Reanimating Faces
// in Images and Video, 2003, section 3.3 and equation 9, which prints the gradient that is not of unit length). Deeper
// inside the picture stays. mask: grey, 255 where the face is.
Image continue_background(const Image& picture, const Image& mask, const FaceFit& fit,
                          const ContinueBackgroundOptions& options = {});

// Pixels of the picture per mm of the face.
double face_scale_px(const FaceFit& fit);

}  // namespace face::texture
