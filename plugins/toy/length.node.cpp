// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/texts.h"
using namespace engine::declare;

NODE("toy.length", &toy::length, version{1}, doc{"Measures a text."}, input{"text", "A text"},
     output("length", "Its bytes"));
