// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/cylinder_scan.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.cylinder_scan", &cylinder_scan, version{2},
     doc{"Reads a laser scan around an axis: a picture of radii, one of colours, and a JSON header."},
     input{"header", "JSON with axis_origin_mm, axis_direction, top_mm, step_mm and radius_unit_mm"},
     input{"radius", "Grey PNG of 16 bits, or EXR; 0 = nothing measured"},
     input{"colour", "A picture of the same size"}, output("scan", "Radius and colour over height and angle"));
