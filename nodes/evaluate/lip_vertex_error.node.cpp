// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/lip_vertex_error.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.lip_vertex_error", &lip_vertex_error, version{2},
     doc{"How far an animation is from the true one: lip vertex error (LVE), its root in mm, mean vertex error and lip "
         "readability, with a curve per frame and a heat map."},
     input{"rig", "The head that both animate"}, input{"weights", "The animation that is judged"},
     input{"truth", "The true weights, frame by frame"},
     input{"lips", "Which vertices are lips; without it those inside the outer lip landmarks"},
     param("readable_mm", &LipVertexErrorOptions::readable_mm, range{0.01, 100}, unit{"mm"},
           "A frame is readable where no lip vertex is farther off"),
     param("full_scale_mm", &LipVertexErrorOptions::full_scale_mm, range{0.01, 1000}, unit{"mm"},
           "Error that is dark red in the heat map"),
     output("table", &LipVertexErrorResult::table,
            "lve_mm2, lip_error_mm (its root), worst_lip_mm, mve_mm, readable_percent, lost_frames"),
     output("frames", &LipVertexErrorResult::frames, "Worst lip vertex and mean of all, per frame; valid is 1"),
     output("heat_map", &LipVertexErrorResult::heat_map, "Mean error of every vertex, in colours"));
