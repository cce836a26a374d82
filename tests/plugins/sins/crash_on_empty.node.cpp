// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.crash_on_empty", &sins::crash_on_empty, version{1}, doc{"Takes the process with it."},
     input{"numbers", "At least one"}, output("sum", "Their sum"));
