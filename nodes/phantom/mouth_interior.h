// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/phantom/head_builder.h"

namespace face::phantom {

// Teeth, gums and tongue, as the parts teeth, gums and tongue.
struct MouthInterior {
  VertexRange upper_teeth, lower_teeth, upper_gums, lower_gums, tongue;
  std::vector<std::uint32_t> upper_front_teeth;  // the six front teeth
};
MouthInterior add_mouth_interior(HeadBuilder& head);

// How far out a vertex of the tongue lies: 0 at the root, 1 at the tip.
double tongue_position(std::uint32_t index_in_tongue);

}  // namespace face::phantom
