// SPDX-License-Identifier: Apache-2.0
#include "plugins/toy/slow_read.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("toy.slow_read", &toy::slow_read, version{1}, doc{"Reads a text file, the second half after a while."},
     input{"file", "A text file"},
     param("seconds", &toy::SlowReadOptions::seconds, range{0, 3600}, unit{"s"}, "How long it waits between the halves",
           inert{"it only takes time"}),
     output("text", "Its content"));
