// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.swap_names", &sins::swap_names, version{1},
     doc{"Calls its inputs and its parameters by each other's names."}, input{"other", "A number"},
     input{"number", "Another number"},
     param("low", &sins::SwapNamesOptions::high, range{0, 10}, unit{"1"}, "The lower end"),
     param("high", &sins::SwapNamesOptions::low, range{0, 10}, unit{"1"}, "The upper end"),
     output("sum", "Of all, by weight"));
