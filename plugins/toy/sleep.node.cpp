// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/trials.h"
using namespace engine::declare;

NODE("toy.sleep", &toy::sleep, version{1}, doc{"Takes a while."}, input{"text", "A text"},
     param("seconds", &toy::SleepOptions::seconds, range{0, 3600}, unit{"s"}, "How long", inert{"it only takes time"}),
     output("rested", "The text"));
