// SPDX-License-Identifier: Apache-2.0
// Where the head is sampled: a raster that hangs at the inner corners of the eyes. Internal to the area.
#pragma once
#include <complex>
#include <cstddef>
#include <vector>

#include "nodes/base/head_facing.h"
#include "nodes/types/landmarks.h"

namespace face::track {

// In distances of the inner corners of the eyes from the middle between them: x to the right in the picture, y down.
inline constexpr int raster_columns = 49, raster_rows = 35;
inline constexpr double raster_left = -1.6, raster_top = -0.9, raster_step = 3.2 / (raster_columns - 1);

// Where a picture has the raster: it lies in the picture's plane, about a head that may be turned.
struct RasterFrame {
  // Of the corners of the eyes, px; from the one on the left to the other, as far as they are apart from the front.
  std::complex<double> middle, across;
  HeadFacing facing;
  double stretch = 1;  // of what is below the eyes, and of all depths: noses differ in length, and faces in size
  bool valid = false;  // false where the points do not say where eyes and tip of the nose are
};

RasterFrame raster_frame(const Landmarks& start);

// How far the points of the 18-point layout are towards the viewer there, before the middle between the eyes, px;
// empty where another point is among them or the frame is not valid.
std::vector<double> usual_depths_px(const Landmarks& start);

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
