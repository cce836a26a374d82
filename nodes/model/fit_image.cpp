// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/fit_image.h"

#include "nodes/model/fit_images.h"

namespace face::model {

FaceFit fit_image(const MorphableModel& model, const Image& picture, const Landmarks& landmarks,
                  const FitImageOptions& options) {
  return fit_pictures(model, {&picture}, {&landmarks}, options).front();
}

}  // namespace face::model
