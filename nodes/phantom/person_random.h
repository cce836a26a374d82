// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "nodes/base/random.h"

namespace face::phantom {

// What a seed decides about a person or a performance, one series each: switching one thing off leaves the others as
// they are. Numbers 1 to 63; a series is drawn from a scrambled seed, since those of neighbouring seeds overlap.
inline Random series(std::int64_t seed, std::uint64_t number) {
  Random first(static_cast<std::uint64_t>(seed), number);
  return Random(first.bits(), number);
}

// Which person: the seed, and where there is an id another one for each (FNV-1a, Fowler, Noll and Vo).
inline std::int64_t person_seed(std::int64_t seed, const std::string* id) {
  if (id == nullptr) return seed;
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const char c : *id) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return static_cast<std::int64_t>((hash ^ static_cast<std::uint64_t>(seed)) >> 1);
}

}  // namespace face::phantom
