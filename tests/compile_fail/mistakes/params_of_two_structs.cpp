// SPDX-License-Identifier: Apache-2.0
// expect: all param(...) members must belong to one options struct
#include "engine/node.h"
#include "tests/compile_fail/mistakes/blur.h"
using namespace engine::declare;
using namespace mistakes;

NODE("image.blur", &blur, version{1},
     doc{"Blurs."},
     input{"image", "Picture"}, input{"mask", "Where"},
     param("radius_px", &BlurOptions::radius_px, range{0, 9}, unit{"px"}, "Width"),
     param("radius_px", &OtherOptions::radius_px, range{0, 9}, unit{"px"}, "Width"),
     output("sharpness", &BlurResult::sharpness, "Before"));
