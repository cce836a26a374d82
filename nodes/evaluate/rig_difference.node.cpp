// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/rig_difference.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.rig_difference", &rig_difference, version{1},
     doc{"How far two heads and their blend shapes are apart, with a heat map of what differs most."},
     input{"a", "A head"}, input{"b", "Another"},
     output("table", &RigDifferenceResult::table,
            "Rows all, neutral and every shape that differs: mean_mm, rms_mm, p95_mm, largest_mm, ..."),
     output("picture", &RigDifferenceResult::picture, "Both, and the distances in colours"));
