// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/base/random.h"

namespace face::phantom {

// What a seed decides about a person or a performance, one series each: switching one thing off leaves the others as
// they are. Numbers 1 to 63; a series is drawn from a scrambled seed, since those of neighbouring seeds overlap.
inline Random series(std::int64_t seed, std::uint64_t number) {
  Random first(static_cast<std::uint64_t>(seed), number);
  return Random(first.bits(), number);
}

}  // namespace face::phantom
