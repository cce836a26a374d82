// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/cylinder_scan.h"
#include "nodes/types/image.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"

namespace face::model {

struct MatchMotionOptions {
  double motion_mm = 4;          // standard deviation of how far places of heads lie apart, along each axis
  double asymmetry = 0.4;        // of motion that is not mirrored, relative to that
  std::int64_t functions = 160;  // smooth functions of a kind
  double surface_mm = 1;         // distance from the scan's surface that counts as one deviation
  double colour_scale = 8;       // difference of colour about features that does, 0 to 255
  double feature_reach_mm = 12;  // how far about the marks of brows, eyes and mouth colours count
  double curvature = 0.2;        // difference of mean curvature times its scale that does
  double curvature_scale_mm = 3;
};

struct MatchMotionResult {
  MeshPoints shape;    // the skin's vertices in the target
  Image texture;       // RGB, V x 1
  double sampled = 0;  // share of the vertices that lie on what is measured
};

// The surface's vertices in a scan of another head, by the most probable smooth motion: for skin without spots, where
// flow (match_cylinder) has nothing to follow. The motion is a Gaussian process of several scales, mostly mirror
// symmetric (motion_basis.h), about the surface; Gauss and Newton's method finds the coefficients with the least sum of
// squares of distances from the scan's tangent planes (Chen and Medioni, Object modelling by registration of multiple
// range images, 1992), differences of mean curvature, differences of colour about brows, eyes and mouth, and the
// coefficients by their deviations; all but the last weighted by 1 / (1 + e^2)^2 (Geman and McClure), wide at first.
// Colours of each feature are compared but for a gain and an offset: hair, lips and skin are other persons'. Vertices
// then go onto the scan where it is no farther than 2 mm. surface: with a shut mouth; its landmarks68 and its middle
// plane are those of a head that looks to +z. reference: the scan that it was cut from. start: where to begin, null =
// the surface itself; what is probable does not depend on it.
MatchMotionResult match_motion(const MorphableModel& surface, const CylinderScan& reference, const MeshPoints* start,
                               const CylinderScan& target, const MatchMotionOptions& options = {});

}  // namespace face::model
