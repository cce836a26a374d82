// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/pose.h"

#include "engine/node.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.pose", &pose, version{1}, doc{"Head poses beside the true ones: angle and distance."},
     input{"motion", "The head's motion in every frame that is judged"}, input{"truth", "The true one"},
     output("table", &PoseResult::table, "Mean, p95 and max of rotation_deg and translation_mm"),
     output("frames", &PoseResult::frames, "Both per frame"));
