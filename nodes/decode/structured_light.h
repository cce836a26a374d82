// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/camera.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/image.h"

namespace face::decode {

struct StructuredLightOptions {
  int projector_width_px = 1024;
  int fine_periods = 32;
  int coarse_periods = 3;
  double near_mm = 800;  // of the depths that can be
  double far_mm = 1150;
  double min_amplitude = 9;    // of the fringes, in 1/255; less is shadow or background
  double max_mismatch = 0.35;  // of a fine period, between coarse and fine fringes; more is motion or an edge
};

// Turns the five pictures of nodes/base/fringe_patterns.h into a scan: per pixel the phase of the fine fringes, counted
// by that of the coarse ones (and those by the range of depths), gives the projector's column; its plane and the
// camera's ray meet at the point. The picture is what the camera sees in the projector's even light, grey, sRGB.
// images: 5, grey, proportional to light, of one size. camera, projector: calibrated, in one world. Throws where the
// images are not five of a size. A pixel that cannot be decoded has the depth 0.
DepthScan structured_light(const engine::Seq<Image>& images, const Camera& camera, const Camera& projector,
                           const StructuredLightOptions& options = {});

}  // namespace face::decode
