// SPDX-License-Identifier: Apache-2.0
// expect: param(...) members must belong to the function's options argument
#include "engine/node.h"
#include "tests/compile_fail/mistakes/blur.h"
using namespace engine::declare;
using namespace mistakes;

NODE("image.blur", &without_options, version{1},
     doc{"Blurs."},
     input{"image", "Picture"},
     param("radius_px", &BlurOptions::radius_px, range{0, 9}, unit{"px"}, "Width"),
     output("sharpness", "Before"));
