// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.default_out_of_range", &sins::default_out_of_range, version{1}, doc{"Has a default that it forbids."},
     input{"number", "A number"},
     param("share", &sins::DefaultOutOfRangeOptions::share, range{0, 1}, unit{"1"}, "A share"),
     output("scaled", "The number times the share"));
