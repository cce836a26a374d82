// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/rig.h"

namespace face {

// Directions in which heads differ (identity modes): offsets of a rig's vertices at one standard deviation.
struct ShapeSet {
  std::vector<Shape> shapes;
};

}  // namespace face
