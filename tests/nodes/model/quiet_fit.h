// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/model/fit_image.h"

namespace face::model {

// For tests that look at the fit alone.
inline FaceFit fit_image(const MorphableModel& model, const Image& picture, const Landmarks& landmarks,
                         const FitImageOptions& options = {}) {
  engine::Progress quiet;
  return fit_image(model, picture, landmarks, options, quiet);
}

}  // namespace face::model
