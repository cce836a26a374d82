// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/head_builder.h"

namespace face::phantom {

// The left and the right eyeball as the parts sclera_left, iris_left (with the pupil), sclera_right, iris_right.
struct Eyes {
  VertexRange left, right;
};
Eyes add_eyes(HeadBuilder& head);

}  // namespace face::phantom
