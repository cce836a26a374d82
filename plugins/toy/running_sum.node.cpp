// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/numbers.h"
using namespace engine::declare;

NODE("toy.running_sum", &toy::running_sum, version{1}, doc{"Sums a sequence of numbers up, element by element."},
     input{"value", "A number"}, output("total", &toy::RunningSum::total, "Sum so far"));
