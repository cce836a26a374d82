// SPDX-License-Identifier: Apache-2.0
// Calls a function that no library has; linked so that only the call would fail.
#include "engine/node.h"

namespace nowhere {
double halve(double number);
}

namespace {
double half(const double& number) { return nowhere::halve(number); }
}  // namespace

using namespace engine::declare;
NODE("missing_symbol.half", &half, version{1}, doc{"Halves a number."}, input{"number", "A number"},
     output("half", "Half of it"));
