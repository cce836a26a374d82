// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/texts.h"
using namespace engine::declare;

NODE("toy.contains", &toy::contains, version{1}, doc{"Looks for a part of a text."}, input{"text", "A text"},
     param("part", &toy::ContainsOptions::part, "What to look for"), output("found", "Whether it is in the text"));
