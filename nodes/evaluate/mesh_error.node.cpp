// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/mesh_error.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.mesh_error", &mesh_error, version{2},
     doc{"evaluate.lip_vertex_error for animations that are vertices instead of weights."},
     input{"rig", "The head whose mesh it is"},
     input{"points", "The vertices of every frame that are judged; a frame without any was lost"},
     input{"truth", "The true ones"},
     input{"lips", "Which vertices are lips; without it those inside the outer lip landmarks"},
     param("readable_mm", &MeshErrorOptions::readable_mm, range{0.01, 100}, unit{"mm"},
           "A frame is readable where no lip vertex is farther off"),
     param("full_scale_mm", &MeshErrorOptions::full_scale_mm, range{0.01, 1000}, unit{"mm"},
           "Error that is dark red in the heat map"),
     output("table", &MeshErrorResult::table,
            "lve_mm2, lip_error_mm (its root), worst_lip_mm, mve_mm, readable_percent, lost_frames"),
     output("frames", &MeshErrorResult::frames,
            "Worst lip vertex and mean of all, per frame; valid is 0 where the frame was lost"),
     output("heat_map", &MeshErrorResult::heat_map, "Mean error of every vertex, in colours"));
