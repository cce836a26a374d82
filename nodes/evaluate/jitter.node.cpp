// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/jitter.h"

#include "engine/node.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.jitter", &jitter, version{1},
     doc{"How much an animation trembles: spread of a still subject, second differences, power above 12 Hz; beside the "
         "truth's."},
     input{"points", "The vertices of every frame that are judged"},
     input{"truth", "The true ones; without them there is no ratio"}, input{"timeline", "When every frame is shown"},
     input{"rig", "With it the 68 landmarks are looked at"},
     input{"vertices", "Which vertices are looked at, in place of the landmarks"},
     param("cut_hz", &JitterOptions::cut_hz, range{0.1, 100}, unit{"Hz"}, "Power above this counts as trembling"),
     output("table", "spread_mm, jerk_mm, high_percent; own, truth and their ratio"));
