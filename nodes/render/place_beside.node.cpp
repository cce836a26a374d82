// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/place_beside.h"

#include "engine/node.h"
#include "nodes/types/image.h"
using namespace engine::declare;
using namespace face::render;

NODE("render.place_beside", &place_beside, version{1}, doc{"Two pictures side by side, brought to one height."},
     input{"left", "A picture"}, input{"right", "Another"},
     param("height_px", &PlaceBesideOptions::height_px, range{2, 4096}, unit{"px"}, "Height of both, even"),
     output("image", "Both"), cheap{});
