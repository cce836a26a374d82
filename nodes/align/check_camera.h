// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "engine/port.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/landmarks.h"

namespace face::align {

struct CheckCameraOptions {
  double upper_share = 0.6;
  std::int64_t frames = 60;  // that are looked at, of all
};

struct CheckCameraResult {
  double stretch_x = 1;  // by which places across the picture must be multiplied: given fx by true fx
  double stretch_y = 1;
  double rms_mm = 0;       // markers about one rigid head, as the camera has it
  double best_rms_mm = 0;  // with the stretches
  bool told = false;       // whether the head turns enough to tell
  bool plausible = true;   // false: told, and fx or fy is another
  std::string report;      // a line, empty without markers
};

// Whether a camera's focal lengths can be true: a head that turns stays the same head only in the right ones. Depth
// does not depend on fx and fy, places across the picture do; with wrong ones a head is flatter or deeper than it is,
// which no single scan shows, but its markers then do not move like a rigid body when it turns. Tried are stretches of
// x and y, a grid from 0.4 to 2.5 refined to 4 %; in each, every frame's markers are brought onto the reference's
// (absolute_orientation, reweighted), and what is left (the median per frame, root mean square over frames) is divided
// by the cube root of the stretches' product: the likelihood of an isotropic error in the stretched space, of which
// what is given is a part that is so much larger. A face's own shape plays no part. It is told where stretches of 1.5
// and 1/1.5 leave 1.25 times as much as the best; fx or fy is another where the best is 15 % or more from 1 and leaves
// less than two thirds. Then a warning says so. Wrong depth units, which make a head larger or smaller, do not show.
// scans, markers: of all frames; those are looked at that are evenly spaced over them. Used are the highest upper_share
// of the reference's markers, as by orient.
CheckCameraResult check_camera(const engine::Seq<DepthScan>& scans, const engine::Seq<Landmarks>& markers,
                               const DepthScan& reference, const Landmarks& reference_markers,
                               const CheckCameraOptions& options, engine::Progress& progress);

}  // namespace face::align
