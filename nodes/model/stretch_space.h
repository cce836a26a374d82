// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/morphable_model.h"
#include "nodes/types/shape_model.h"

namespace face::model {

struct StretchSpaceOptions {
  double place_mm = 6;    // standard deviation of where a head is
  double stretch_mm = 6;  // of what stretching it moves its border by
  double bend_mm = 3;     // of what bending it does, half of it for bends of third order
};

// Directions in which any head may differ from a surface before anything is known of persons: along each axis the
// polynomials up to third order in the height and width of a place on the face, from -1 to 1, and its depth. For
// model.closest_combination, so that flow begins with the eyes on the eyes. Made, not learned. The skin's vertices.
ShapeModel stretch_space(const MorphableModel& surface, const StretchSpaceOptions& options = {});

}  // namespace face::model
