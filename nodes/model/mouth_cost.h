// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

#include "nodes/model/fit_joint.h"

namespace face::model {

// How badly the lips of a closed mouth explain the pixels that an open one leaves between its lips: Geman and McClure's
// cost, mean over them, 0 to 1; 0 where there are none. What is there if the mouth is open (teeth, tongue, dark) has no
// model; but lips do not look like it. open, closed: two states of the same pictures. level: of picture `index`.
double mouth_cost(const Joint& open, const Joint& closed, std::size_t index, const PictureLevel& level);

}  // namespace face::model
