// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.ignore_parameter", &sins::ignore_parameter, version{1}, doc{"Does not look at its parameter."},
     input{"number", "A number"},
     param("amount", &sins::IgnoreParameterOptions::amount, range{0, 10}, unit{"1"}, "Not looked at"),
     output("same", "The number"));
