// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/face_fit.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/morphable_model.h"

namespace face::model {

struct FitLandmarksOptions {
  std::int64_t identities = 40;  // components used at most
  std::int64_t expressions = 10;
  double point_sigma = 0.02;  // error of a placed point, as a share of the distance of the outer corners of the eyes
  double focal_share = 1.8;   // likeliest focal length over the larger side of the picture
  double focal_sigma = 0.35;  // of its logarithm
  double mouth_evidence = 6;  // by how much the squared errors must fall for an open mouth to be believed
  double max_nme = 0.06;      // mean error of the points, over the eye distance, above which a fit is not believed
  double max_turn_deg = 60;
  std::int64_t iterations = 12;
};

// Pose, focal length, identity and expression from named points alone: a joint Gauss-Newton with the model's priors
// and robust weights, started from three directions, contour points given new vertices in every round (Blanz et al.
// 2003, section 3.1, E_F and E_P of equations 7 and 8). Differs from the paper: second order; the mouth stays closed
// unless the points say otherwise; lips do not run into each other; a point that contradicts the others is named.
// picture: only its size counts. converged is false, with what to do in `problem`, where there are too few points, they
// contradict each other, or the head is turned too far.
FaceFit fit_landmarks(const MorphableModel& model, const Landmarks& landmarks, const Image& picture,
                      const FitLandmarksOptions& options = {});

}  // namespace face::model
