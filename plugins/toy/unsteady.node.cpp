// SPDX-License-Identifier: Apache-2.0
#include "plugins/toy/unsteady.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("toy.unsteady", &toy::unsteady, version{1},
     doc{"A bad example: its result depends on when it runs. `facegraph cache audit` finds such nodes."},
     input{"text", "A text"}, param("unsteady", &toy::UnsteadyOptions::unsteady, "Whether it reads the clock"),
     output("changed", "The text, with a time behind it"));
