// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/scanned_rig.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.scanned_rig", &scanned_rig, version{1},
     doc{"A scanned person as a rig whose shapes are the scanned expressions, by their ids."},
     input{"surface", "The reference surface, with its teeth"}, input{"expressions", "The person's shapes, at rest"},
     input{"neutral", "The neutral one of them"}, output("rig", "The person"),
     output("poses", "Weights that show each expression"));
