// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/trials.h"
using namespace engine::declare;

NODE("toy.fail", &toy::fail, version{1}, doc{"Fails for some texts."}, input{"text", "A text"},
     param("when", &toy::FailOptions::when, "What the text must not contain"), output("checked", "The text"));
