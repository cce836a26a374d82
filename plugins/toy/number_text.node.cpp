// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/numbers.h"
using namespace engine::declare;

NODE("toy.number_text", &toy::number_text, version{1}, doc{"Writes a number as text."}, input{"number", "A number"},
     output("text", "In decimal digits"));
