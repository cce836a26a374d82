// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "nodes/types/camera.h"
#include "nodes/types/image.h"
#include "nodes/types/lighting.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/surface_dots.h"
#include "nodes/types/weights.h"

namespace face::phantom {

struct VideoFrameOptions {
  int width_px = 640;
  int height_px = 480;
  int samples = 2;        // per pixel and axis
  bool highlight = true;  // mirrored parallel light
  bool shadow = true;     // soft shadow of the parallel light, darkness in creases and in the mouth
  bool gamma = true;      // light adds up as light and is then coded as sRGB; off: colours are multiplied as they are
  double grain = 2.0;     // standard deviation of the sensor's noise, in 1/255; 0 = off
  std::int64_t seed = 1;
};

// One frame of a video of a head: what the camera sees under one parallel and one ambient light (lighting.h). With
// highlight, shadow and gamma off every pixel of the skin is exactly Lighting's equation at the sample's interpolated
// normal and albedo; each of the three is something that a fit with that equation does not model. Lashes are half
// transparent over it. The background is not lit, but seen by the same camera (contrast, gain, offset, grain).
// world_from_head null: at rest. dots null: none. backdrop null: an even grey, else of the picture's size.
// id: the frame's, for its grain.
Image video_frame(const Rig& rig, const Weights& weights, const RigidMotion* world_from_head, const Camera& camera,
                  const Lighting& lighting, const SurfaceDots* dots, const Image* backdrop, const std::string* id,
                  const VideoFrameOptions& options = {});

}  // namespace face::phantom
