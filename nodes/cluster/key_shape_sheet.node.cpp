// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/key_shape_sheet.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::cluster;

NODE("cluster.key_shape_sheet", &key_shape_sheet, version{2},
     doc{"Shows an artist what to sculpt: every key shape's frame, and how many shapes the performance needs."},
     input{"key_shapes", "The shapes, from cluster.key_shapes"}, input{"frames", "The video they were found in, or these frames of it"},
     input{"tracks", "The landmarks as they lie in the frames; without it those of the key shapes are drawn"},
     input{"curve", "Error and cost of merging, from cluster.merge"},
     param("columns", &KeyShapeSheetOptions::columns, range{1, 100}, unit{"1"}, "Pictures in a row"),
     param("picture_px", &KeyShapeSheetOptions::picture_px, range{32, 2000}, unit{"px"},
           "Width and height of one picture"),
     output("sheet", "The pictures"));
