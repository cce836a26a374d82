// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/base/grey_spline.h"
#include "nodes/transfer/outline.h"
#include "nodes/types/image.h"

namespace face::transfer {

// A picture's two layers, the skin about an opening and the eye in it. A pixel at the outline sees both; each layer is
// freed of the other's light, and goes on below the other as at its own edge. Laid on each other as in the picture they
// are the picture.
struct OpeningLayers {
  GreySpline skin, eye;
};
OpeningLayers opening_layers(const Image& picture, const Outline& outline);

}  // namespace face::transfer
