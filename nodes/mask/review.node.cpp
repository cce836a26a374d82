// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/review.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mask;

NODE("mask.review", &review, version{1},
     doc{"Looks over the removal of mouths in a sequence: proposes other thresholds for frames that are in doubt, and "
         "shows what was removed."},
     input{"scans", "The scans"}, input{"interiors", "What was removed of each"},
     input{"reports", "mask.remove_mouth's report on each"},
     param("pictures", &ReviewOptions::pictures, range{1, 1000}, unit{"1"}, "Largest number of pictures on the sheet"),
     param("columns", &ReviewOptions::columns, range{1, 100}, unit{"1"}, "Pictures per row"),
     param("picture_px", &ReviewOptions::picture_px, range{16, 2048}, unit{"px"}, "Width and height of a picture"),
     param("doubt", &ReviewOptions::doubt, range{0.0, 100.0}, unit{"1"},
           "Share of the area by which a frame may change or depart before it is doubtful"),
     output("doubtful", &ReviewResult::doubtful, "Frames that may need another threshold, and which"),
     output("overrides", &ReviewResult::overrides, "The same, ready to be pasted as overrides of mask.remove_mouth"),
     output("sheet", &ReviewResult::sheet, "Doubtful mouths first; red is removed"));
