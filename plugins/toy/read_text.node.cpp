// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/texts.h"
using namespace engine::declare;

NODE("toy.read_text", &toy::read_text, version{1}, doc{"Reads a text file."}, input{"file", "A text file"},
     output("text", "Its content"));
