// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/add_grain.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/mmm.h"
#include "nodes/types/weights.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.add_grain", &add_grain, version{1},
     doc{"Gives a synthesised mouth the camera noise that is lost where pictures are mixed."},
     input{"model", "From mmm.build"}, input{"parameters", "Those that the picture was made at"},
     input{"image", "From mmm.synthesise"}, input{"id", "The frame's, so that each has noise of its own"},
     param("amount", &AddGrainOptions::amount, range{0.0, 10.0}, unit{"1"}, "1 = as much as is missing, 0 = none"),
     param("seed", &AddGrainOptions::seed, range{0, 1000000000}, unit{"1"}, "Another number is other noise"),
     output("grainy", "The picture with grain"));
