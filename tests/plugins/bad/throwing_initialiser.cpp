// SPDX-License-Identifier: Apache-2.0
// Its initialiser throws.
#include <stdexcept>

#include "engine/node.h"

namespace {

double half(const double& number) { return number / 2; }

int look_for_a_licence() { throw std::runtime_error("the licence has expired"); }
const int licence = look_for_a_licence();

}  // namespace

using namespace engine::declare;
NODE("throwing_initialiser.half", &half, version{1}, doc{"Halves a number."}, input{"number", "A number"},
     output("half", "Half of it"));
