// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.swap_units", &sins::swap_units, version{1}, doc{"Promises seconds and takes milliseconds."},
     input{"number", "A number"},
     param("window_s", &sins::SwapUnitsOptions::window_s, range{0, 10}, unit{"ms"}, "A time"),
     output("scaled", "The number times the time"));
