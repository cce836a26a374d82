// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/shape_rig.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.shape_rig", &shape_rig, version{1}, doc{"A scanned shape with its colours as a head to look at."},
     input{"surface", "The reference surface, with its teeth"}, input{"shape", "Its skin in a shape"},
     input{"texture", "Colours of the skin, one row; without it the surface's own"}, output("rig", "The head"));
