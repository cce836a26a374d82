// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/weights.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Weights, "weights", codec_version{1}, doc{"Blend-shape weights of one frame."}, field<&Weights::values>(),
     difference{"evaluate.weights_difference"});
