// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/stretch_space.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.stretch_space", &stretch_space, version{1},
     doc{"Directions in which any head may differ from a scanned one: placed, stretched and bent; before anything is "
         "known of persons."},
     input{"surface", "The reference surface"},
     param("place_mm", &StretchSpaceOptions::place_mm, range{0.0, 100.0}, unit{"mm"}, "Spread of a head's place"),
     param("stretch_mm", &StretchSpaceOptions::stretch_mm, range{0.0, 100.0}, unit{"mm"},
           "Spread of what stretching moves the border by"),
     param("bend_mm", &StretchSpaceOptions::bend_mm, range{0.0, 100.0}, unit{"mm"}, "Spread of what bending does"),
     output("space", "For model.closest_combination"));
