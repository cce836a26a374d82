// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/face_fit.h"
#include "nodes/types/image.h"
#include "nodes/types/morphable_model.h"

namespace face::texture {

struct DrawFitOptions {
  double opacity = 0.8;
};

// The fitted face over its picture, in grey: whether shape and pose are right shows better without colours.
Image draw_fit(const MorphableModel& model, const FaceFit& fit, const Image& picture,
               const DrawFitOptions& options = {});

}  // namespace face::texture
