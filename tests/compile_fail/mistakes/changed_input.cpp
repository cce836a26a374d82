// SPDX-License-Identifier: Apache-2.0
// expect: a node may not modify its inputs: take them by const reference
#include "engine/node.h"
#include "tests/compile_fail/mistakes/blur.h"
using namespace engine::declare;
using namespace mistakes;

NODE("image.blur", &blur_in_place, version{1},
     doc{"Blurs."},
     input{"image", "Picture"},
     param("radius_px", &BlurOptions::radius_px, range{0, 9}, unit{"px"}, "Width"),
     output("sharpness", &BlurResult::sharpness, "Before"));
