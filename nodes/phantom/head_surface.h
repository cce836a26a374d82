// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/vector3.h"

namespace face::phantom {

// A place on the head's skin, seen from the chart's centre: azimuth (0 front, 90 the head's left, +-180 back) and
// elevation (90 crown). Below -45 degrees the chart runs down the neck, which ends at -81.
struct ChartPoint {
  double azimuth_deg = 0;
  double elevation_deg = 0;
};

// The skin without eyes and lips: skull, jaw and neck from a table of radii (head_surface.cpp), plus the nose.
Vector3 skin_point(ChartPoint at);

// The same without the nose.
Vector3 skull_point(ChartPoint at);

// How dark the skin is for lying in a nostril: 0 to 1.
double nostril_darkness(ChartPoint at);

// Chart place of a point above the neck; inverse of skull_point() along the ray from the chart's centre.
ChartPoint to_chart(Vector3 point_mm);

}  // namespace face::phantom
