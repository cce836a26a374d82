// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/numbers.h"
using namespace engine::declare;

NODE("toy.add", &toy::add, version{1}, doc{"Adds numbers."}, input{"a", "A number"},
     input{"b", "Another; 0 where absent"},
     param("amount", &toy::AddOptions::amount, range{-1000, 1000}, unit{"1"}, "Added too"),
     output("sum", "a + b + amount"));
