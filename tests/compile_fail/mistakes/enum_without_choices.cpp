// SPDX-License-Identifier: Apache-2.0
// expect: a number needs range and unit, an enum its choices
#include "engine/node.h"
#include "tests/compile_fail/mistakes/blur.h"
using namespace engine::declare;
using namespace mistakes;

NODE("image.blur", &blur, version{1},
     doc{"Blurs."},
     input{"image", "Picture"}, input{"mask", "Where"},
     param("edge", &BlurOptions::edge, "Ends"),
     output("sharpness", &BlurResult::sharpness, "Before"));
