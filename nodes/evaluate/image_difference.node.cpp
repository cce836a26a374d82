// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/image_difference.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.image_difference", &image_difference, version{1}, doc{"How two pictures differ, and where."},
     input{"a", "A picture"}, input{"b", "Another"},
     output("table", &ImageDifferenceResult::table, "rms_levels, largest_levels, differing_percent, psnr_db, pixels"),
     output("picture", &ImageDifferenceResult::picture, "Both, and where they differ"));
