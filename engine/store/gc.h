// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <unordered_set>

#include "engine/store/index.h"
#include "engine/store/objects.h"
#include "engine/store/store.h"

namespace engine::store {

struct GcLimits {
  std::uint64_t max_bytes = 0;
  double max_age_s = 0;             // 0 = any age
  std::int64_t spare_ns = 0;        // what was used since then stays
  bool spare_small_values = false;  // another store is open, whose reads of small values are not in the index yet
};

// Removes bytes, least recently used first, never those of `pinned`. Index rows stay.
GcResult collect(Index& index, Objects& objects, const std::unordered_set<Digest>& pinned, const GcLimits& limits);

}  // namespace engine::store
