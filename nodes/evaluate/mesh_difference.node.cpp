// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/mesh_difference.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.mesh_difference", &mesh_difference, version{1},
     doc{"How far the vertices of two meshes are apart as they stand, with a heat map."}, input{"a", "A mesh"},
     input{"b", "Another"},
     output("table", &MeshDifferenceResult::table,
            "mean_mm, rms_mm, p95_mm, largest_mm, moved_percent, vertices, matched (0: nearest vertices)"),
     output("picture", &MeshDifferenceResult::picture, "Both, and the distances in colours"));
