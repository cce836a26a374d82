// SPDX-License-Identifier: Apache-2.0
// Where the head is sampled: a raster that hangs at the inner corners of the eyes. Internal to the area.
#pragma once
#include <complex>
#include <cstddef>
#include <vector>

#include "nodes/types/landmarks.h"

namespace face::track {

// In distances of the inner corners of the eyes from the middle between them: x to the right in the picture, y down.
inline constexpr int raster_columns = 49, raster_rows = 35;
inline constexpr double raster_left = -1.6, raster_top = -0.9, raster_step = 3.2 / (raster_columns - 1);

// Where a picture has the raster.
struct RasterFrame {
  std::complex<double> middle, across;  // of the corners of the eyes; from the one on the left to the other, px
  double stretch = 1;                   // of what is below the eyes: noses differ in length
  bool valid = false;                   // false where the points do not say where eyes and tip of the nose are
};

RasterFrame raster_frame(const Landmarks& start);

// A place of the raster, counted from the middle between the eyes, px: in the start's picture, and towards the viewer.
struct Knot {
  std::size_t index = 0;  // in the raster, row by row
  std::complex<double> place_px;
  double depth_px = 0;
  bool solid = true;  // moves with the head and not by itself
};

// Every `stride`-th of every `stride`-th row.
std::vector<Knot> raster_knots(const RasterFrame& frame, int stride);

}  // namespace face::track
