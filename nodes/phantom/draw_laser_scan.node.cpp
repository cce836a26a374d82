// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/phantom/draw_scan.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.draw_laser_scan", &draw_laser_scan, version{1}, cheap{},
     doc{"A cylindrical scan, to look at: the lit surface with its holes, and its colours."},
     input{"scan", "A cylindrical scan"}, output("image", "Surface and colours side by side"));
