// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

#include "nodes/model/fit_joint.h"

namespace face::model {

// Whether edges of the drawn face lie where the picture has edges: the correlation of both gradients of luminance over
// the skin that is seen below the brows, -1 to 1; 0 where there is none. A wall is explained by light and skin without
// any error, but has no lips, nostrils and brows. level: of picture `index`, small enough that grain does not count.
double likeness(const Joint& joint, std::size_t index, const PictureLevel& level);

}  // namespace face::model
