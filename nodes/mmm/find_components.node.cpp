// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/find_components.h"

#include "engine/node.h"
#include "nodes/types/matrix.h"
#include "nodes/types/mmm.h"
#include "nodes/types/weights.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.find_components", &find_components, version{1},
     doc{"A few uncorrelated numbers of variance 1 in place of a mouth model's parameters."},
     input{"model", "From mmm.build"}, input{"parameters", "Of every frame, from mmm.analyse"},
     param("count", &FindComponentsOptions::count, range{1, 1000}, unit{"1"}, "Numbers at most",
           inert{"few frames vary in fewer ways"}),
     output("components", "The mean, the rows to numbers, the rows back"));
