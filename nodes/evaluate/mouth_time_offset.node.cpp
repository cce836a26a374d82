// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/mouth_time_offset.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.mouth_time_offset", &mouth_time_offset, version{1},
     doc{"How late the mouth moves: time between matched extrema of the lips' opening and of the mouth's width (MTM)."},
     input{"rig", "The head that both animate"}, input{"weights", "The animation that is judged"},
     input{"truth", "The true weights, frame by frame"}, input{"timeline", "When every frame is shown"},
     param("prominence_mm", &MouthTimeOffsetOptions::prominence_mm, range{0.001, 100}, unit{"mm"},
           "An extremum differs by this from its neighbours"),
     param("max_offset_ms", &MouthTimeOffsetOptions::max_offset_ms, range{1, 5000}, unit{"ms"},
           "Extrema farther apart are not the same event"),
     output("table", "offset_ms, late_ms, matched, missing_percent and extra_percent of opening, width and both"));
