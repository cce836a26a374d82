// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/add_albedo.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.add_albedo", &add_albedo, version{1},
     doc{"Gives a morphable model without colours those of made skins; what the model has is kept."},
     input{"model", "A morphable model, as decode.model reads it"},
     param("albedos", &AddAlbedoOptions::albedos, range{0, 99}, unit{"1"}, "Albedo components at most"),
     param("skins", &AddAlbedoOptions::skins, range{0, 1000}, unit{"1"},
           "Made persons' skins they come from; 0 = waves alone"),
     param("seed", &AddAlbedoOptions::seed, range{0, 1000000000}, unit{"1"}, "Of the skins"),
     output("with_albedo", "The same model with albedo"));
