// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/from_scans.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.from_scans", &from_scans, version{1},
     doc{"A morphable model from scans: expressions of one person, identities and colours of many, analysed apart."},
     input{"surface", "The reference surface, with its teeth"},
     input{"expressions", "Shapes of one person's expressions, at rest"}, input{"neutral", "The neutral one of them"},
     input{"identities", "Shapes of neutral persons in the same topology, at rest"}, input{"textures", "Their colours"},
     param("expression_components", &FromScansOptions::expression_components, range{0, 200}, unit{"1"},
           "Expression components kept"),
     param("identity_components", &FromScansOptions::identity_components, range{0, 1000}, unit{"1"},
           "Identity components kept"),
     param("albedo_components", &FromScansOptions::albedo_components, range{0, 1000}, unit{"1"},
           "Albedo components kept"),
     param("lamp_shading", &FromScansOptions::lamp_shading, range{0.0, 0.99}, unit{"1"},
           "How much the scanner's colours darken with the angle to its lamp; 0 = not"),
     output("model", "The morphable model"));
