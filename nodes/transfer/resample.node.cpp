// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/resample.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.resample", &resample, version{1},
     doc{"A head of the identity model's mesh, at any weights, in the topology of the speaking model."},
     input{"places", "From transfer.look_up"}, input{"head", "The head"},
     input{"weights", "Its pose; unconnected: neutral"},
     input{"world_from_head", "Motion of the head to where the speaking model is; unconnected: none"},
     input{"mesh", "The speaking model's mesh"}, input{"shape", "Its vertices in the neutral frame"},
     output("points", "The head's points, vertex by vertex of the speaking model"));
