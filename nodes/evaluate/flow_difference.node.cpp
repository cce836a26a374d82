// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/evaluate/number_differences.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.flow_difference", &flow_difference, version{1}, doc{"How far two flows of one picture are apart."},
     input{"a", "A flow"}, input{"b", "Another"},
     output("table", "mean_px, p95_px, largest_px, only_in_a, only_in_b (pixels)"));
