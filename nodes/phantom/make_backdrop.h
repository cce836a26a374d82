// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/image.h"

namespace face::phantom {

struct MakeBackdropOptions {
  int width_px = 640;
  int height_px = 480;
  double contrast = 0.5;  // of the texture; 0 = an even grey
  std::int64_t seed = 1;
};

// A textured background: a wall of warm and cool blotches with a shelf of upright shapes, out of focus, so that nothing
// behind a face is flat (value noise of four octaves; Perlin, An Image Synthesizer, SIGGRAPH 1985).
Image make_backdrop(const MakeBackdropOptions& options = {});

}  // namespace face::phantom
