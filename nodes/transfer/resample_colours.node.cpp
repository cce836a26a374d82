// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/transfer/resample.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.resample_colours", &resample_colours, version{1}, doc{"The speaking model's mesh in a head's colours."},
     input{"places", "From transfer.look_up"}, input{"head", "The head"}, input{"mesh", "The speaking model's mesh"},
     output("coloured", "The mesh in the head's colours"));
