// SPDX-License-Identifier: Apache-2.0
// expect: declare doc{...} exactly once
#include "engine/node.h"
#include "tests/compile_fail/mistakes/blur.h"
using namespace engine::declare;
using namespace mistakes;

NODE("image.blur", &blur, version{1},
     doc{"Blurs."},
     doc{"Again."},
     input{"image", "Picture"}, input{"mask", "Where"},
     output("sharpness", &BlurResult::sharpness, "Before"));
