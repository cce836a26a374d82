// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/face_fit.h"
#include "nodes/types/image.h"
#include "nodes/types/morphable_model.h"

namespace face::texture {

// Where a fit's face is in its picture: grey, 255 inside its contour.
Image face_mask(const MorphableModel& model, const FaceFit& fit);

}  // namespace face::texture
