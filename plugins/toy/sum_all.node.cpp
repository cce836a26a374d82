// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/numbers.h"
using namespace engine::declare;

NODE("toy.sum_all", &toy::sum_all, version{1}, doc{"Sums all numbers of a sequence."}, input{"numbers", "Numbers"},
     output("sum", "Their sum"));
