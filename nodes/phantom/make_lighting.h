// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/lighting.h"

namespace face::phantom {

struct MakeLightingOptions {
  double yaw_deg = -35;   // where the parallel light comes from; positive: from the head's left
  double pitch_deg = 30;  // positive: from above
  double parallel_red = 0.68, parallel_green = 0.64, parallel_blue = 0.58;
  double ambient_red = 0.33, ambient_green = 0.35, ambient_blue = 0.38;
  double contrast = 1;
  double gain_red = 1, gain_green = 1, gain_blue = 1;
  double offset_red = 0, offset_green = 0, offset_blue = 0;
};

// The light on a face, as lighting.h defines it, from numbers.
Lighting make_lighting(const MakeLightingOptions& options = {});

}  // namespace face::phantom
