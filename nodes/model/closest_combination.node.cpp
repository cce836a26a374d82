// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/closest_combination.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE(
    "model.closest_combination", &closest_combination, version{1},
    doc{"The linear combination of shapes that comes closest to a scan around an axis: where flow to the scan begins."},
    input{"scan", "The scan"}, input{"surface", "The reference surface (model.scan_template)"},
    input{"space", "Shapes of the surface found so far (model.region_pca); without it the surface itself"},
    param("by_hand", &ClosestCombinationOptions::by_hand, range{-100.0, 100.0}, unit{"1"},
          "Coefficients in standard deviations, for a scan whose own are not found; empty = found"),
    param("components", &ClosestCombinationOptions::components, range{0, 200}, unit{"1"}, "Modes used at most"),
    param("radius_scale_mm", &ClosestCombinationOptions::radius_scale_mm, range{0.01, 100.0}, unit{"mm"},
          "Difference of radius that counts as unlike"),
    param("colour_scale", &ClosestCombinationOptions::colour_scale, range{0.1, 1000.0}, unit{"1"},
          "Difference of colour, in steps of 8 bits, that counts as unlike"),
    output("coefficients", &ClosestCombinationResult::coefficients, "In standard deviations"),
    output("shape", &ClosestCombinationResult::shape, "The combination"),
    output("difference", &ClosestCombinationResult::difference,
           "Of combination and scan: 0 = none, 1 = nothing alike"));
