// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/evaluate/map_differences.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.cylinder_scan_difference", &cylinder_scan_difference, version{1},
     doc{"How far two scans around an axis are apart."}, input{"a", "A scan"}, input{"b", "Another"},
     output("table", &MapDifferenceResult::table,
            "mean_mm, p95_mm, largest_mm, only_in_a, only_in_b (pixels), picture_rms_levels, same_grid"),
     output("picture", &MapDifferenceResult::picture, "Both, and where they differ"));
