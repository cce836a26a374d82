// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/analyse.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.analyse", &analyse, version{1},
     doc{"Where a picture lies in the space of a mouth model: how flows, and how pictures are mixed."},
     input{"model", "From mmm.build"}, input{"image", "A picture of the mouth, as those of the model"},
     param("restraint", &AnalyseOptions::restraint, range{0.0, 100.0}, unit{"1"},
           "Pulls the flows' shares to 0, as a share of the flows' mean square"),
     param("sum_to_one", &AnalyseOptions::sum_to_one, "The pictures' shares sum to 1"),
     param("stride_px", &AnalyseOptions::stride_px, range{1, 64}, unit{"px"}, "Every n-th pixel and row counts"),
     output("parameters", &AnalyseResult::parameters, "2 N: alpha, then beta"),
     output("rms", &AnalyseResult::rms, "Of what is left of the picture, grey levels"));
