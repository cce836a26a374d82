// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/cylinder_colours.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::flow;

NODE("flow.cylinder_colours", &cylinder_colours, version{2},
     doc{"Radius and colour, and on demand curvature, of a scan around an axis: what laser scans are matched by."},
     input{"scan", "The scan"},
     param("half_angle_deg", &CylinderColoursOptions::half_angle_deg, range{1.0, 180.0}, unit{"deg"},
           "What is farther from the front does not count"),
     param("curvature_scale_mm", &CylinderColoursOptions::curvature_scale_mm, range{0.0, 100.0}, unit{"mm"},
           "Smoothing before mean curvature is taken, as one more channel; 0 = none"),
     cheap{},
     output("channels", "Channels radius (mm), red, green and blue (0 to 255), and curvature where it is asked for"));
