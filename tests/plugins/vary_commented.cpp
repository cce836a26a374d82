// SPDX-License-Identifier: Apache-2.0
// A plugin that is built in several variants, to see which rebuilds rerun what. VARY_CODE: other code, the same
// results. VARY_VERSION: another node version. This is vary.cpp with comments and blank lines in it.
#include <string>

#include "engine/node.h"

// A comment that was not there before.

namespace vary {

#ifdef VARY_CODE
double twice(const double& number) { return number * 4 / 2; }
#else
double twice(const double& number) {
  // Added to itself.
  return number + number;
}
#endif

}  // namespace vary

using namespace engine::declare;

#ifndef VARY_VERSION
#define VARY_VERSION 1
#endif

NODE("vary.twice", &vary::twice, version{VARY_VERSION}, doc{"Doubles a number."}, input{"number", "A number"},
     output("doubled", "Twice the number"));
