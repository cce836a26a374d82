// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "engine/port.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/timeline.h"

namespace face::decode {

struct DepthTakeOptions {
  double near_mm = 150;
  double far_mm = 4000;
  double least_width_mm = 60;
  double most_width_mm = 1200;
  double face_change_mm = 150;
  double least_face = 0.4;
};

struct DepthTakeResult {
  Timeline timeline;         // of the frames kept; missing numbers leave their time
  std::string report;        // a line for everything that was wrong, naming the frame
  std::int64_t dropped = 0;  // frames that were left out
  bool kept = true;          // false: none is left, and the take is to be left out
};

// Reads one take of a recorded stream of scans from a folder:
//   camera.json           fx, fy, cx, cy and the like (scan_camera_file.h)
//   depth/TAKE/17.png     16-bit depth, or .exr; 0 or not finite = nothing measured
//   cloud/TAKE/17.ply     or an organised cloud (.ply, .xyz) in the camera's frame (x right, y down, z forward, or y up
//                         and z negative), a point per pixel in reading order
//   pattern/TAKE/17/0.png to 4.png   or the five fringe pictures of a structured-light scanner (structured_light.h),
//   grey,
//                         proportional to light; projector.json (scan_projector_file.h) says what they are
//   picture/TAKE/17.png   grey or RGB, registered with the depth (not needed beside a cloud with colours or
//                         fringes)
//   mask/TAKE/17.png      white where depth counts (may be missing)
// The frames are those that have depth, a cloud or fringes, by number; their ids are the numbers. What one frame has
// wrong is reported with its number, shown as a warning, and the rest is kept: a file that cannot be read, sizes that
// differ, an empty mask, nothing measured; a median depth outside near_mm to far_mm (a swapped unit: the message says
// which would do); a width of what is measured outside least_width_mm to most_width_mm (wrong intrinsics); a cloud's
// points that the intrinsics do not bring to their pixels, by more than 2 px in the median. Then, against the take's
// medians: a frame without a face has less than least_face of the measured pixels, or lies farther than face_change_mm
// before or behind. Numbers that are missing between the first and the last are named too. Throws where camera.json is
// wrong or absent and where the take has no frame. A take of which no frame is left has no scans and a warning with the
// reason of the first. Pixels that are not square become so by resampling rows (depth: the nearest, pictures: linear).
DepthTakeResult depth_take(const engine::File& folder, const std::string& take, engine::SeqWriter<DepthScan>& scans,
                           const DepthTakeOptions& options, engine::Progress& progress);

}  // namespace face::decode
