// SPDX-License-Identifier: Apache-2.0
// expect: declare one input{...} per input of the function, in the function's order
#include "engine/node.h"
#include "tests/compile_fail/mistakes/blur.h"
using namespace engine::declare;
using namespace mistakes;

NODE("image.blur", &blur, version{1},
     doc{"Blurs."},
     input{"image", "Picture"},
     output("sharpness", &BlurResult::sharpness, "Before"));
