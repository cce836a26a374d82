// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/fill_holes.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mask;

NODE("mask.fill_holes", &fill_holes, version{1}, cheap{},
     doc{"Closes holes in the depth of a scan by linear interpolation along its rows."}, input{"scan", "The scan"},
     param("longest_px", &FillHolesOptions::longest_px, range{1, 10000}, unit{"px"}, "Longest gap that is filled"),
     param("largest_step_mm", &FillHolesOptions::largest_step_mm, range{0.0, 10000.0}, unit{"mm"},
           "Largest difference in depth between the ends of a gap that is filled"),
     param("vertical_too", &FillHolesOptions::vertical_too, "Mixes in what columns say, so that rows do not show"),
     output("scan", &FillHolesResult::scan, "The scan with its holes filled"),
     output("filled", &FillHolesResult::filled, "White where depth was filled in"));
