// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/line_mouth.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.line_mouth", &line_mouth, version{3},
     doc{"Spans the opening between a speaking model's lips with a dark surface that moves with them."},
     input{"rig", "The speaking model"}, input{"mesh", "Its reference's mesh, whose mouth is open"},
     param("brightness", &LineMouthOptions::brightness, range{0.0, 1.0}, unit{"1"},
           "Of the lips' colours there; 0 = black"),
     param("rim_mm", &LineMouthOptions::rim_mm, range{0.0, 10.0}, unit{"mm"},
           "How far each lip may grow to meet the other where the neutral's are apart"),
     output("lined", "The rig with the part \"mouth\""));
