// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/flow/scan_channels.h"
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/feature_map.h"
using namespace engine::declare;
using namespace face::flow;

NODE("flow.cylinder_channels", &cylinder_channels, version{1},
     doc{"Radius and grey value of a scan around an axis: what scans are matched by."}, input{"scan", "The scan"},
     cheap{}, output("channels", "Channels radius (mm) and grey (0 to 255)"));
