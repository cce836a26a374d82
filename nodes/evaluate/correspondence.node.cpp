// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/correspondence.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE(
    "evaluate.correspondence", &correspondence, version{1},
    doc{"Distance of every vertex to its true place after rigid alignment without scale, per region, with a heat map."},
    input{"rig", "The head whose mesh it is"}, input{"points", "The vertices that are judged"},
    input{"truth", "The true ones"}, input{"rigid", "Vertices to align by; without it skin that the jaw leaves alone"},
    param("full_scale_mm", &CorrespondenceOptions::full_scale_mm, range{0.01, 1000}, unit{"mm"},
          "Error that is dark red in the heat map"),
    output("table", &CorrespondenceResult::table, "mean_mm, median_mm, p95_mm, max_mm per region"),
    output("truth_from_points", &CorrespondenceResult::truth_from_points, "The motion that was taken out"),
    output("heat_map", &CorrespondenceResult::heat_map, "Error of every vertex, in colours"));
