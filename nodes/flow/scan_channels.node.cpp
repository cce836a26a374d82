// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/scan_channels.h"

#include "engine/node.h"
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/feature_map.h"
using namespace engine::declare;
using namespace face::flow;

NODE("flow.scan_channels", &scan_channels, version{1},
     doc{"Radius and grey value of a depth scan: what scans are matched by."}, input{"scan", "The scan"},
     input{"axis", "Axis of the head; without it y through the origin"}, cheap{},
     output("channels", "Channels radius (mm) and grey (0 to 255)"));
