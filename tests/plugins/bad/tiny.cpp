// SPDX-License-Identifier: Apache-2.0
// A good plugin. The name of its node is long enough to be replaced in the library's bytes.
#include "tests/plugins/bad/point.h"

namespace {
tiny::Point make_point(const double& number) { return {number}; }
}  // namespace

using namespace engine::declare;
NODE("tiny.make_point_000", &make_point, version{1}, doc{"Makes a point of a number."}, input{"number", "A number"},
     output("point", "The point"));
