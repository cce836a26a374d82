// SPDX-License-Identifier: Apache-2.0
// expect: 'blurred' is not a member of 'mistakes::BlurResult' | no member named 'blurred' in 'mistakes::BlurResult'
#include "engine/node.h"
#include "tests/compile_fail/mistakes/blur.h"
using namespace engine::declare;
using namespace mistakes;

NODE("image.blur", &blur, version{1},
     doc{"Blurs."},
     input{"image", "Picture"}, input{"mask", "Where"},
     output("sharpness", &BlurResult::blurred, "Before"));
