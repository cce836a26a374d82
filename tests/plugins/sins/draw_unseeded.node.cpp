// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.draw_unseeded", &sins::draw_unseeded, version{1}, doc{"Draws without a seed."}, input{"number", "A number"},
     output("drawn", "Other at every call"));
