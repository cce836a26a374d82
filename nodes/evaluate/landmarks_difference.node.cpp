// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/landmarks_difference.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.landmarks_difference", &landmarks_difference, version{1},
     doc{"How far the points of one picture are from others of the same names."}, input{"a", "Points"},
     input{"b", "Others"},
     output("table", &LandmarksDifferenceResult::table,
            "Rows all and every point that moved: rms_px, largest_px, lost_in_a, lost_in_b"),
     output("picture", &LandmarksDifferenceResult::picture, "The points of a in green, those of b as red rings"));
