// SPDX-License-Identifier: Apache-2.0
// expect: a list of choices needs an enum
#include "engine/node.h"
#include "tests/compile_fail/mistakes/blur.h"
using namespace engine::declare;
using namespace mistakes;

NODE("image.blur", &blur, version{1},
     doc{"Blurs."},
     input{"image", "Picture"}, input{"mask", "Where"},
     param("radius_px", &BlurOptions::radius_px, {{"narrow", 1.0}, {"wide", 4.0}}, "Width"),
     output("sharpness", &BlurResult::sharpness, "Before"));
