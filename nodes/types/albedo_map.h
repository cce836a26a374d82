// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/vec.h"

namespace face {

// A face's own colour over its mesh's uvs: row 0 is the top (v = 1). Linear reflectance; it may pass 1 where a picture
// had a highlight that its light does not explain.
struct AlbedoMap {
  int width = 0;
  int height = 0;
  std::vector<Vec3f> albedo;  // height x width
  std::vector<float> weight;  // height x width: how well the pictures show it; 0 = taken from the model
};

}  // namespace face
