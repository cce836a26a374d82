// SPDX-License-Identifier: Apache-2.0
// expect: range and unit belong to a number
#include "engine/node.h"
#include "tests/compile_fail/mistakes/blur.h"
using namespace engine::declare;
using namespace mistakes;

NODE("image.blur", &blur, version{1},
     doc{"Blurs."},
     input{"image", "Picture"}, input{"mask", "Where"},
     param("fast", &BlurOptions::fast, range{0, 1}, unit{"1"}, "Roughly"),
     output("sharpness", &BlurResult::sharpness, "Before"));
