// SPDX-License-Identifier: Apache-2.0
// Declares a node that the plugin tiny has too.
#include "engine/node.h"
namespace {
double half(const double& number) { return number / 2; }
}  // namespace

using namespace engine::declare;
NODE("tiny.make_point_000", &half, version{1}, doc{"Halves a number."}, input{"number", "A number"},
     output("half", "Half of it"));
