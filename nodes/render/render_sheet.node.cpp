// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/render_sheet.h"

#include "engine/node.h"
#include "nodes/types/image.h"
#include "nodes/types/phones.h"
#include "nodes/types/rig.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"
using namespace engine::declare;
using namespace face::render;

NODE("render.contact_sheet", &render_sheet, version{1},
     doc{"Contact sheet of an animation: key frames with the phone, its word and its time under each."},
     input{"rig", "Head and its blend shapes"}, input{"weights", "Blend-shape weights of every frame"},
     input{"timeline", "When every frame is shown"}, input{"phones", "What is said when"},
     param("pictures", &RenderSheetOptions::pictures, range{1, 400}, unit{"1"}, "Largest number of pictures"),
     param("columns", &RenderSheetOptions::columns, range{1, 100}, unit{"1"}, "Pictures per row"),
     param("picture_px", &RenderSheetOptions::picture_px, range{32, 2048}, unit{"px"}, "Width and height of a picture"),
     param("yaw_deg", &RenderSheetOptions::yaw_deg, range{-180, 180}, unit{"deg"},
           "Camera's place about the head; positive shows the head's left side"),
     output("image", "The sheet"));
