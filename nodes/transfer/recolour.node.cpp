// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/recolour.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.recolour", &recolour, version{1}, doc{"Gives a speaking face, recorded in grey, other colours."},
     input{"mesh", "The speaking model's mesh"}, input{"colours", "Its vertices in the colours to take"},
     param("recorded", &RecolourOptions::recorded, range{0.0, 1.0}, unit{"1"},
           "How much of the recorded light and dark stays: 0 = replaced, 1 = hue and saturation alone are new"),
     param("smooth_mm", &RecolourOptions::smooth_mm, range{0.0, 100.0}, unit{"mm"},
           "How far the new colours are averaged along the mesh"),
     output("recoloured", "The mesh in its new colours"));
