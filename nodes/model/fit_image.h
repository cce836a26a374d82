// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/morphable_model.h"

namespace face::model {

struct FitImageOptions {
  std::int64_t identities = 99;  // components at most
  std::int64_t albedos = 99;
  std::int64_t expressions = 10;
  std::int64_t points = 1500;   // random pixels per step and picture
  std::int64_t steps = 12;      // per size
  double image_weight = 500;    // how many independent points the picture counts as
  double point_sigma = 0.02;    // as in fit_landmarks
  double mouth_sigma_mm = 2;    // of the lip gap about 0; an open mouth must be seen
  double max_image_rms = 0.12;  // difference of picture and model above which the fit is not believed
  std::int64_t seed = 1;
};

// Analysis by synthesis of one picture: pose, focal length, light, contrast, gain and offset, identity, albedo and
// expression such that the drawn model looks like it. Starts from fit_landmarks; then the points' weight falls and the
// picture's grows while its size grows (Blanz, Basso, Poggio, Vetter: Reanimating Faces in Images and Video,
// Eurographics 2003, section 3.1, equations 5-8). Each step compares a new random set of pixels. Differs from the
// paper: Gauss-Newton steps instead of gradient descent, two lobes of mirrored light (what shines on a ridge is taken
// for relief without them), robust weights (what no model explains, hair above all, counts little), sRGB decoded before
// light is computed, no lip may run into the other, a dark picture is fitted as if its skin were of usual brightness
// (gain and offset tell), and mouths that are shut, or nearly, are tried both ways. A fit that is not to be believed is
// a warning, too.
FaceFit fit_image(const MorphableModel& model, const Image& picture, const Landmarks& landmarks,
                  const FitImageOptions& options, engine::Progress& progress);

}  // namespace face::model
