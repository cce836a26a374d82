// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.ignore_input", &sins::ignore_input, version{1}, doc{"Does not look at its second input."},
     input{"number", "A number"}, input{"other", "Not looked at"}, output("same", "The number"));
