// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/transfer/opening_scene.h"

namespace face::transfer {

struct FitOpeningResult {
  OpeningPose pose;
  double cost = 0;
};

// Finds where sheet and eye are in a frame by drawing them: the sum of robust squared differences between drawing and
// picture, of the sheet's bends, of its rim's distance from where the start has it, and of light that is not even, is
// made small (Gauss-Newton with the drawing's own gradients, damped as by Marquardt, An Algorithm for Least-Squares
// Estimation of Nonlinear Parameters, 1963). An edge between skin and eye that the drawing has in the wrong place is a
// difference, and so is moved to where the picture has it, by what the edge sweeps (share_slopes); the white of an eye
// where the frame has none counts in full at first, when the robust scale is four times as large, and less later (Blake
// and Zisserman, Visual Reconstruction, 1987). At first bends count more, too: a sheet that is soft from the start
// tears its edge at the lashes. held: the start's rim and eye.
FitOpeningResult fit_opening(const OpeningScene& scene, const Image& frame, const OpeningPose& start,
                             const OpeningPose& held);

}  // namespace face::transfer
