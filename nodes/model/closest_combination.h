// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/types/cylinder_scan.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/shape_model.h"
#include "nodes/types/weights.h"

namespace face::model {

struct ClosestCombinationOptions {
  std::vector<double> by_hand;  // coefficients in standard deviations; empty = found
  std::int64_t components = 20;
  double radius_scale_mm = 2;
  double colour_scale = 30;  // 0 to 255
};

struct ClosestCombinationResult {
  Weights coefficients;   // in standard deviations of the space's modes
  MeshPoints shape;       // V
  double difference = 0;  // 0 = the scan, 1 = nothing alike: mean of e / (1 + e) over the skin
};

// The combination of a space's modes that comes closest to a scan, where flow to the scan begins. Blanz et al. 2003
// (section 2.3) adjust the coefficients in an interactive tool; here they are found: every vertex of a combination is
// looked up in the scan, e = (difference of radius / radius_scale_mm)^2 + |difference of colour|^2 / colour_scale^2
// (the mean difference of each colour over the skin does not count: persons and lamps differ),
// and the sum of e / (1 + e) (Geman and McClure) and of the squared coefficients is lowered by Levenberg and Marquardt,
// on a blurred scan first, from the mean and from 1.5 standard deviations of the first modes to either side, the two
// best of which are followed. by_hand replaces all that. surface: its skin vertices are those of the space. space:
// null = none yet, the surface itself.
ClosestCombinationResult closest_combination(const CylinderScan& scan, const MorphableModel& surface,
                                             const ShapeModel* space, const ClosestCombinationOptions& options = {});

}  // namespace face::model
