// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "engine/port.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/morphable_model.h"

namespace face::model {

// The most probable path of something that is measured in every frame with an error, and moves with random
// accelerations: both Gaussian and independent. values: the path's second differences, which are all that the path's
// shape depends on. Returns what is to be added to the measured path, two longer: it minimises sum added^2 + ratio
// sum (second differences of both)^2 (Whittaker, On a New Method of Graduation, 1923), ratio being the error's variance
// over the accelerations'. That is the most likely one (Harvey, Forecasting, Structural Time Series Models and the
// Kalman Filter, 1989, sections 2.3 and 3.4), so what does not tremble stays as it is.
std::vector<double> most_probable_correction(const std::vector<double>& second_differences);

// A track with the poses that all of its frames together make most probable: tracking knows of a frame only what was
// before, and its error trembles. Each axis of the turn is taken by itself; the head turns about the middle of its
// face, which stays where it is in the picture. Mouths are as fast as their error and stay as they are. Between frames
// that are not believed every stretch is by itself; one of less than 12 frames, too few to know two variances, stays.
// Stretches that are not believed are warnings.
void smooth_track(const MorphableModel& model, const engine::Seq<FaceFit>& fits, engine::SeqWriter<FaceFit>& smoothed,
                  engine::Progress& progress);

}  // namespace face::model
