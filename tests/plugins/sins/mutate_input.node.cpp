// SPDX-License-Identifier: Apache-2.0
#include "tests/plugins/sins/sins.h"

#include "engine/node.h"
using namespace engine::declare;

NODE("sins.mutate_input", &sins::mutate_input, version{1}, doc{"Writes into its input."}, input{"number", "A number"},
     output("doubled", "Twice the number"));
