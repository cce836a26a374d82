// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/from_rig.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.from_rig", &from_rig, version{1},
     doc{"A morphable model from a rig and its identity modes; its albedo components are made, not measured."},
     input{"rig", "A head and its blend shapes"}, input{"identities", "Directions in which heads differ"},
     param("expressions", &FromRigOptions::expressions, range{1, 60}, unit{"1"}, "Expression components kept"),
     param("albedos", &FromRigOptions::albedos, range{0, 99}, unit{"1"}, "Albedo components kept at most"),
     param("samples", &FromRigOptions::samples, range{1, 5000}, unit{"1"},
           "Faces drawn from the rig for its expression space"),
     param("skins", &FromRigOptions::skins, range{0, 1000}, unit{"1"},
           "Made persons' skins for its albedo space; 0 = waves alone"),
     param("seed", &FromRigOptions::seed, range{0, 1000000000}, unit{"1"}, "Of the drawn faces"),
     output("model", "The morphable model"));
