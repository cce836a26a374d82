// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "tests/plugins/sins/sins.h"
using namespace engine::declare;

NODE("sins.only_refuse", &sins::only_refuse, version{1},
     doc{"Fails for some values of its parameter and its second input, and looks at neither otherwise."},
     input{"number", "A number"}, input{"other", "Too large or not"},
     param("most", &sins::OnlyRefuseOptions::most, range{0, 10}, unit{"1"}, "Numbers may be as large"),
     output("same", "The number"));
