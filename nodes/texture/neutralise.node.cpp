// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/neutralise.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::texture;

NODE("texture.neutralise", &neutralise, version{3},
     doc{"The person in a picture as a rig: expression taken out, identity and colours kept, shapes as the rig's."},
     input{"model", "The morphable model of the fit"}, input{"rig", "The rig that the model was made from"},
     input{"fit", "The fit"}, input{"albedo", "The face's colours"},
     param("light_share", &NeutraliseOptions::light_share, range{0.0, 1.0}, unit{"1"},
           "Of the difference in brightness to the mean person, what is taken to be the light's; 0 = none"),
     param("hair_contrast", &NeutraliseOptions::hair_contrast, range{0.0, 10.0}, unit{"1"},
           "Difference to skin in the cheeks' tone, as a logarithm, from which forehead, temples and neck are hidden; "
           "0 = never, and what only one side shows stays"),
     output("person", "The person as a rig"));
