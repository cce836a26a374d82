// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/picture_sheet.h"

#include "engine/node.h"
#include "nodes/types/image.h"
using namespace engine::declare;
using namespace face::render;

NODE("render.picture_sheet", &picture_sheet, version{1},
     doc{"Pictures of one size in rows, each with its id under it."}, input{"images", "The pictures"},
     param("columns", &PictureSheetOptions::columns, range{1, 100}, unit{"1"}, "Pictures per row"),
     param("captions", &PictureSheetOptions::captions, "Writes the ids"), output("image", "The sheet"));
