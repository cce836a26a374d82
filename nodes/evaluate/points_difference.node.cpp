// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/evaluate/mesh_difference.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.points_difference", &points_difference, version{1},
     doc{"How far the vertices of one frame are apart in two animations."}, input{"a", "Vertices of a mesh"},
     input{"b", "Others"},
     output("table", "mean_mm, rms_mm, p95_mm, largest_mm, moved_percent, vertices, matched (0: nearest vertices)"));
