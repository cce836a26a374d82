// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.say_nothing", &sins::say_nothing, version{1}, doc{""}, input{"number", ""}, output("same", ""));
