// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/points_still.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::render;

NODE("render.points_still", &points_still, version{1},
     doc{"Shows vertices as dots, from the front and from their left."}, input{"points", "Vertices of a mesh"},
     output("image", "The pictures side by side"));
