// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/texts.h"
using namespace engine::declare;

NODE("toy.concat", &toy::concat, version{1}, doc{"Joins a sequence of texts."}, input{"texts", "Texts"},
     param("separator", &toy::ConcatOptions::separator, "Put between them"), output("text", "All in one"));
