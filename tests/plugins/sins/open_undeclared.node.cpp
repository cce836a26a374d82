// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.open_undeclared", &sins::open_undeclared, version{1}, doc{"Opens a file that it was not given."},
     input{"text", "A text"}, output("longer", "The text and the file's first line"));
