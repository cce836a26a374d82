// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/model/match_cylinder.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.draw_cylinder", &draw_cylinder, version{1},
     doc{"What a scanner that turns about the head would see of a surface in a shape: radius and colour."},
     input{"surface", "The reference surface, with teeth where it has any"}, input{"shape", "Its skin in a shape"},
     input{"reference", "The scan that the surface was cut from: grid and colours"},
     output("scan", "Radius and colour over height and angle"));
