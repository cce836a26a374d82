// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/numbers.h"
using namespace engine::declare;

NODE("toy.random_number", &toy::random_number, version{1}, doc{"A random number for every element."},
     input{"id", "The element's id, from seq.ids"},
     param("seed", &toy::RandomNumberOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed, other numbers"),
     output("number", "In [0, 1)"));
