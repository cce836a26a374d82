// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/fit_image.h"

#include "nodes/model/fit_images.h"

namespace face::model {

FaceFit fit_image(const MorphableModel& model, const Image& picture, const Landmarks& landmarks,
                  const FitImageOptions& options, engine::Progress& progress) {
  FaceFit fit = fit_pictures(model, {&picture}, {&landmarks}, options).front();
  if (!fit.converged) progress.warn("the fit is not to be used: " + fit.problem);
  return fit;
}

}  // namespace face::model
