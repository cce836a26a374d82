// SPDX-License-Identifier: Apache-2.0
#include "nodes/weights/fit_key_shapes.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::weights;

NODE("weights.fit_key_shapes", &fit_key_shapes, version{1},
     doc{"Weights of the key shapes for every frame of a performance."}, input{"tracks", "Landmarks of every frame"},
     input{"key_shapes", "The shapes that are mixed"},
     input{"neutral", "The landmarks at rest: weights are of what differs from them"},
     param("method", &FitKeyShapesOptions::method,
           {{"nonnegative", FitMethod::nonnegative}, {"least_squares", FitMethod::least_squares}},
           "Weights >= 0, or of any sign for comparison"),
     param("sum_to_one", &FitKeyShapesOptions::sum_to_one, "The weights of a frame add up to one"),
     param("max_lost", &FitKeyShapesOptions::max_lost, range{0, 1000}, unit{"1"},
           "So many landmarks of a frame may be lost: they count where the tracker has left them"),
     output("weights", "One weight per key shape; none where too many landmarks are lost"));
