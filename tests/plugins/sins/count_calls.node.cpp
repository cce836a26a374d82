// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.count_calls", &sins::count_calls, version{1}, doc{"Keeps a count between calls."},
     input{"number", "A number"}, output("counted", "Other at every call"));
