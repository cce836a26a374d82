// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/draw_scan.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.draw_scan", &draw_scan, version{1}, cheap{},
     doc{"What a scanner has measured, to look at: the lit surface with its holes, and the scanner's picture."},
     input{"scan", "A frame of the scanner"}, output("image", "Surface and picture side by side"));
