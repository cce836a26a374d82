// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "plugins/toy/texts.h"
using namespace engine::declare;

NODE("toy.upper", &toy::upper, version{1}, doc{"Changes the case of a text."}, input{"text", "A text"},
     param("mode", &toy::UpperOptions::mode,
           {{"upper", toy::UpperOptions::Mode::upper},
            {"lower", toy::UpperOptions::Mode::lower},
            {"title", toy::UpperOptions::Mode::title}},
           "Which case"),
     output("changed", "The text in that case"));
