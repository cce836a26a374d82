// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/depth_scan.h"

namespace face::align {

struct FitAxisOptions {
  double tilt_stiffness = 2000;
};

struct FitAxisResult {
  Axis axis;
  double mean_radius_mm = 0;
  double rms_mm = 0;  // of the radius about its mean, robust
};

// The vertical axis of a head, fitted to the reference scan so that the distance to it varies least over the surface:
// robust least squares of |across(p - o)| - r over o, tilt and r (Gauss-Newton, Geman and McClure's weights of scale 15
// mm). The paper's Eq. 1 takes the coordinate axis; here it is a value, so that scans need not be centred.
// tilt_stiffness: pull of the direction towards the camera's up, in squared mm per squared radian and point.
FitAxisResult fit_axis(const DepthScan& reference, const FitAxisOptions& options = {});

}  // namespace face::align
