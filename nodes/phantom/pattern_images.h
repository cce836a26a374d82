// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "engine/port.h"
#include "nodes/types/camera.h"
#include "nodes/types/image.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/surface_dots.h"
#include "nodes/types/weights.h"

namespace face::phantom {

struct PatternImagesOptions {
  int width_px = 640;
  int height_px = 480;
  int projector_width_px = 1024;
  int projector_height_px = 768;
  int fine_periods = 32;
  int coarse_periods = 3;
  double exposure_step = 0.2;  // frames between two pictures; 0: the head stands still meanwhile
  double exposure = 0.85;      // grey of a white surface that faces the projector, of 1
  double ambient = 0.12;       // light beside the projector's
  double grey_noise = 1.5;     // standard deviation of the pictures, in 1/255; 0 = off
  std::int64_t seed = 1;
};

// The five raw pictures of one frame of a structured-light scanner, each at its own moment, under the fringes of
// nodes/base/fringe_patterns.h. Grey, 8 bits that are proportional to light (not sRGB), as such cameras give.
// weights, world_from_head: the frame and one on either side. dots, id: may be null.
void pattern_images(const Rig& rig, const engine::Window<Weights>& weights,
                    const engine::Window<RigidMotion>& world_from_head, const Camera& camera, const Camera& projector,
                    const SurfaceDots* dots, const std::string* id, engine::SeqWriter<Image>& images,
                    const PatternImagesOptions& options = {});

}  // namespace face::phantom
