// SPDX-License-Identifier: Apache-2.0
// Its initialiser ends the process.
#include <cstdio>
#include <cstdlib>

#include "engine/node.h"

namespace {

double half(const double& number) { return number / 2; }

int crash() {
  std::fputs("first line\n\n  second line\n", stderr);
  std::abort();
}
const int crashed = crash();

}  // namespace

using namespace engine::declare;
NODE("crashing_initialiser.half", &half, version{1}, doc{"Halves a number."}, input{"number", "A number"},
     output("half", "Half of it"));
