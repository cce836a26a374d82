// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/trials.h"
using namespace engine::declare;

NODE("toy.mark", &toy::mark, version{1}, cheap{}, doc{"Writes a number over the first bytes of a large value; the result is not stored."},
     input{"blob", "A large text"}, input{"number", "A number"}, output("marked", "Both"));
