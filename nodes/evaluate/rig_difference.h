// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/rig.h"
#include "nodes/types/table.h"

namespace face::evaluate {

struct RigDifferenceResult {
  Table table;
  Image picture;  // of what differs most: the neutral head, or the head with the shape at weight 1
};

// Two heads beside each other: row "all" (mean over the neutral head and all shapes), "neutral", and a row for every
// shape whose offsets differ, by name; a shape that only one has differs by all that it moves. Columns as
// mesh_difference. Where the heads have not as many vertices their neutral heads alone are compared, by nearest
// vertices.
RigDifferenceResult rig_difference(const Rig& a, const Rig& b);

}  // namespace face::evaluate
