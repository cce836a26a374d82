// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/override_overlap.h"

#include <algorithm>
#include <map>

#include "engine/base/element_id.h"

namespace engine {
namespace {

struct Entry {
  const Override::Range* range;
  const Override* override;
  std::size_t order;
};

std::string text_of(const Override::Range& range) {
  std::string text;
  for (const std::string& parent : range.parents) text += parent + "/";
  return text + range.first + (range.first == range.last ? "" : "-" + range.last);
}

}  // namespace

void check_overrides(const FlatNode& node, int mapped_depth, std::vector<Problem>& problems) {
  if (node.overrides.empty()) return;
  if (mapped_depth == 0) {
    problems.push_back({node.overrides[0].place,
                        "'" + node.id + "' is not mapped over a sequence: there are no elements to override"});
    return;
  }
  using Parents = std::vector<std::string>;
  std::map<Parents, std::vector<Entry>> groups;  // by parents; no parents = under every parent
  std::size_t order = 0;
  for (const Override& override : node.overrides)
    for (const Override::Range& range : override.ranges) {
      const std::size_t levels = range.parents.size();
      if (levels != 0 && static_cast<int>(levels) != mapped_depth - 1)
        problems.push_back({override.place, "'" + text_of(range) + "' has " + std::to_string(levels + 1) +
                                                " levels, but '" + node.id + "' is mapped over " +
                                                std::to_string(mapped_depth)});
      else
        groups[range.parents].push_back({&range, &override, order++});
    }
  const std::vector<Entry> everywhere = groups.count(Parents{}) != 0 ? groups[Parents{}] : std::vector<Entry>{};
  for (auto& [parents, entries] : groups) {
    if (!parents.empty()) entries.insert(entries.end(), everywhere.begin(), everywhere.end());
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      if (a.range->first != b.range->first) return id_before(a.range->first, b.range->first);
      return a.order < b.order;
    });
    const Entry* widest = nullptr;
    for (const Entry& entry : entries) {
      const bool overlaps = widest != nullptr && !id_before(widest->range->last, entry.range->first);
      const bool told = overlaps && !parents.empty() && widest->range->parents.empty() && entry.range->parents.empty();
      if (overlaps && !told) {
        const Entry& later = widest->order < entry.order ? entry : *widest;
        const Entry& earlier = widest->order < entry.order ? *widest : entry;
        problems.push_back(
            {later.override->place,
             "'" + text_of(*later.range) + "' overlaps '" + text_of(*earlier.range) + "' of " +
                 (later.override == earlier.override ? "the same key" : "\"" + earlier.override->text + "\"") +
                 ": which value holds would be a guess"});
      }
      if (widest == nullptr || id_before(widest->range->last, entry.range->last)) widest = &entry;
    }
  }
}

}  // namespace engine
