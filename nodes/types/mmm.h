// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/types/image.h"

namespace face {

// One picture of the mouth, and where the reference's pixels are in it.
struct MmmPrototype {
  std::string frame;                       // id of the frame that it is
  Image image;                             // all of one size and three channels
  std::vector<std::int16_t> flow_64th_px;  // height x width x 2 (x, y): displacement from the reference, 1/64 px
};

// A multidimensional morphable model of a mouth: N prototypes in the order of the frames, and which is the reference
// (its flow is 0). A picture of the model has 2 N parameters: alpha mixes flows, beta mixes pictures.
struct Mmm {
  std::vector<MmmPrototype> prototypes;
  std::int64_t reference = 0;
};

}  // namespace face
