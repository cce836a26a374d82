// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/surface_map.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.surface_map", &surface_map, version{1},
     doc{"Which point of a head every pixel of a camera shows: the truth beside a picture."},
     input{"rig", "Head and its blend shapes"}, input{"weights", "Blend-shape weights of the frame"},
     input{"world_from_head", "Where the head is; unconnected: at rest"}, input{"camera", "Where it is seen from"},
     param("width_px", &SurfaceMapOptions::width_px, range{1, 4096}, unit{"px"}, "Width of the picture"),
     param("height_px", &SurfaceMapOptions::height_px, range{1, 4096}, unit{"px"}, "Height of the picture"),
     output("map", "Triangle and barycentric weights of every pixel"));
