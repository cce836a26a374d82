// SPDX-License-Identifier: Apache-2.0
#include "engine/store/gc.h"

#include <algorithm>
#include <vector>

#include "engine/store/posix.h"

namespace engine::store {

GcResult collect(Index& index, Objects& objects, const std::unordered_set<Digest>& pinned, const GcLimits& limits) {
  struct Candidate {
    Objects::Item item;
    bool small = false;
  };
  std::vector<Candidate> candidates;
  GcResult result;
  const auto add = [&](Objects::Item item, bool small) {
    result.kept_bytes += item.size;
    if (item.used_ns >= limits.spare_ns || (small && limits.spare_small_values) || pinned.contains(item.digest)) return;
    candidates.push_back({std::move(item), small});
  };
  objects.for_each([&](Objects::Item item) { add(std::move(item), false); });
  for (const Index::SmallValue& value : index.small_values())
    add({{}, value.digest, false, value.size, value.used_ns}, true);

  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.item.used_ns != b.item.used_ns ? a.item.used_ns < b.item.used_ns : a.item.digest < b.item.digest;
  });
  const std::int64_t oldest_ns =
      limits.max_age_s > 0 ? now_ns() - static_cast<std::int64_t>(limits.max_age_s * 1e9) : 0;
  std::vector<Digest> small;
  for (const Candidate& candidate : candidates) {
    if (result.kept_bytes <= limits.max_bytes && candidate.item.used_ns >= oldest_ns) break;
    if (candidate.small)
      small.push_back(candidate.item.digest);
    else if (!objects.remove_unused(candidate.item, limits.spare_ns))
      continue;
    ++result.removed_objects;
    result.removed_bytes += candidate.item.size;
    result.kept_bytes -= candidate.item.size;
  }
  if (!small.empty()) index.remove_values(small);
  return result;
}

}  // namespace engine::store
