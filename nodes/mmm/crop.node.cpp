// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/crop.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.crop", &crop, version{1}, doc{"A part of a picture: the lower face, for a mouth model."},
     input{"image", "The picture"},
     input{"landmarks", "Points on the face, of which the lower part is taken; in place of the parameters"},
     param("left_px", &CropOptions::left_px, range{0, 16384}, unit{"px"}, "First column",
           inert{"landmarks take its place"}),
     param("top_px", &CropOptions::top_px, range{0, 16384}, unit{"px"}, "First row", inert{"landmarks take its place"}),
     param("width_px", &CropOptions::width_px, range{1, 16384}, unit{"px"}, "Columns",
           inert{"landmarks take its place"}),
     param("height_px", &CropOptions::height_px, range{1, 16384}, unit{"px"}, "Rows",
           inert{"landmarks take its place"}),
     output("part", "The part"));
