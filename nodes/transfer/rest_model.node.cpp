// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/transfer/move_model.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.rest_model", &rest_model, version{1},
     doc{"The same space of shapes with its coefficients counted from the neutral face in place of the mean."},
     input{"model", "The space"}, input{"rest", "The neutral face, from transfer.rest_shape"},
     output("rested", "The space whose mean is the neutral face, as the space can show it"));
