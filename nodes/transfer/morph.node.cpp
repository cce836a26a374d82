// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/morph.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.morph", &morph, version{1}, cheap{}, doc{"A speaking face that turns into another while it speaks."},
     input{"from", "The recorded face"}, input{"to", "The new face, in the same topology"},
     input{"weights", "What both say"},
     param("begin", &MorphOptions::begin, range{0.0, 1.0}, unit{"1"}, "Share of the frames at which it begins"),
     param("end", &MorphOptions::end, range{0.0, 1.0}, unit{"1"}, "Share at which the new face is there"),
     output("heads", "Every frame as a head of its own"), output("poses", "How it is posed"));
