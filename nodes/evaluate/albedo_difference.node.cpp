// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/evaluate/map_differences.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.albedo_difference", &albedo_difference, version{1},
     doc{"How far the own colours of two faces are apart."}, input{"a", "A map"}, input{"b", "Another"},
     output("table", &MapDifferenceResult::table,
            "mean, p95, largest (linear reflectance), only_in_a, only_in_b (pixels seen in pictures)"),
     output("picture", &MapDifferenceResult::picture, "Both, and where they differ"));
