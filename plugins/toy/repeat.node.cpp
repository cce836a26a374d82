// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/texts.h"
using namespace engine::declare;

NODE("toy.repeat", &toy::repeat, version{1}, doc{"Makes a sequence of one text."}, input{"text", "A text"},
     param("times", &toy::RepeatOptions::times, range{1, 1000}, unit{"1"}, "How many copies"),
     output("texts", "The copies, numbered"));
