// SPDX-License-Identifier: Apache-2.0
// Its type tiny_point has one member more than that of tiny.
#define TINY_POINT_IN_SPACE
#include "tests/plugins/bad/point.h"

namespace {
tiny::Point lift_point(const double& number) { return {number, 1}; }
}  // namespace

using namespace engine::declare;
NODE("other_layout.lift_point", &lift_point, version{1}, doc{"Makes a point of a number."}, input{"number", "A number"},
     output("point", "The point"));
