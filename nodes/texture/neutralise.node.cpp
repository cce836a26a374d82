// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/neutralise.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::texture;

NODE("texture.neutralise", &neutralise, version{1},
     doc{"The person in a picture as a rig: expression taken out, identity and colours kept, shapes as the rig's."},
     input{"model", "The morphable model of the fit"}, input{"rig", "The rig that the model was made from"},
     input{"fit", "The fit"}, input{"albedo", "The face's colours"}, output("person", "The person as a rig"));
