// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.read_clock", &sins::read_clock, version{1}, doc{"Puts the time into its result."},
     input{"number", "A number"}, output("now", "Other at every moment"));
