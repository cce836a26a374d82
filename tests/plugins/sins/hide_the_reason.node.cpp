// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.hide_the_reason", &sins::hide_the_reason, version{1}, doc{"Fails with a library's words."},
     input{"text", "At least two characters"}, output("sum", "A number"));
