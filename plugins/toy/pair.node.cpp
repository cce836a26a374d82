// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/texts.h"
using namespace engine::declare;

NODE("toy.pair", &toy::pair, version{1}, doc{"Puts two texts side by side."}, input{"left", "A text"},
     input{"right", "Another"}, output("both", "The two, with a space between them"));
