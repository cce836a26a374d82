// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/look_up.h"

#include "engine/node.h"
#include "nodes/types/surface_map.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.look_up", &look_up, version{2},
     doc{"Which point of a model of identities every vertex of a speaking model is: the same height and angle, and the "
         "same lip."},
     input{"model", "The model of identities"}, input{"fitted", "Its vertices, fitted to the neutral frame"},
     input{"mesh", "The speaking model's mesh"}, input{"shape", "Its vertices in the neutral frame"},
     input{"axis", "The axis of both"},
     param("reach_mm", &LookUpOptions::reach_mm, range{0.0, 100.0}, unit{"mm"},
           "How far beside a vertex a triangle may lie, where none covers it"),
     param("lip_reach_mm", &LookUpOptions::lip_reach_mm, range{0.0, 1000.0}, unit{"mm"},
           "How far from the seam, along the skin, upper and lower lip are kept apart"),
     param("depth_mm", &LookUpOptions::depth_mm, range{0.0, 1000.0}, unit{"mm"},
           "How far behind or before a vertex a triangle may lie"),
     output("places", "Triangle and weights of every vertex, in a row"));
