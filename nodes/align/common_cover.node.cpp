// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/align/crop.h"
using namespace engine::declare;
using namespace face::align;

NODE("align.common_cover", &common_cover, version{1},
     doc{"What nearly all scans have measured, in the cylindrical representation: the common crop."},
     input{"covers", "Of every scan, from align.cover"},
     param("share", &CommonCoverOptions::share, range{0.0, 1.0}, unit{"1"}, "Share of the scans that must have it"),
     param("shrink_cells", &CommonCoverOptions::shrink_cells, range{0, 100}, unit{"1"},
           "Cells by which the border is drawn in"),
     output("mask", "White where it is common"));
