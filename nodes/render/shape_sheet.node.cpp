// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/shape_sheet.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/rig.h"
using namespace engine::declare;
using namespace face::render;

NODE("render.shape_sheet", &shape_sheet, version{1},
     doc{"Contact sheet of a head: neutral and every ARKit shape at weight 1 with its name (mouthClose together with "
         "jawOpen). A second head, where given, stands beside the first at the same weights."},
     input{"rig", "Head and its blend shapes"}, input{"beside", "Another head, shown to the right of it"},
     param("columns", &ShapeSheetOptions::columns, range{1, 100}, unit{"1"}, "Shapes per row"),
     param("picture_px", &ShapeSheetOptions::picture_px, range{32, 2048}, unit{"px"}, "Width and height of one head"),
     param("yaw_deg", &ShapeSheetOptions::yaw_deg, range{-180.0, 180.0}, unit{"deg"},
           "Camera's place about the head; positive shows the head's left side"),
     param("framing", &ShapeSheetOptions::framing, {{"head", Framing::head}, {"face", Framing::face}},
           "What stands in the middle of a picture: the head, or the face from brows to chin"),
     output("image", "The sheet"));
