// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/trials.h"
using namespace engine::declare;

NODE("toy.count_up", &toy::count_up, version{1}, cheap{}, doc{"Counts."},
     param("count", &toy::CountUpOptions::count, range{0, 1000000}, unit{"1"}, "How many numbers"),
     output("numbers", "0, 1, 2, ..."));
