// SPDX-License-Identifier: Apache-2.0
// expect: declare one output(name, text) for the result (unless its members are declared) and one per SeqWriter
#include "engine/node.h"
#include "tests/compile_fail/mistakes/blur.h"
using namespace engine::declare;
using namespace mistakes;

NODE("image.blur", &blur_and_stream, version{1},
     doc{"Blurs."},
     input{"image", "Picture"},
     output("sharpness", "Before"));
