// SPDX-License-Identifier: Apache-2.0
// Needs libgone.so.
#include "engine/node.h"

double gone(double number);

namespace {
double half(const double& number) { return gone(number) / 2; }
}  // namespace

using namespace engine::declare;
NODE("missing_dependency.half", &half, version{1}, doc{"Halves a number."}, input{"number", "A number"},
     output("half", "Half of it"));
