// SPDX-License-Identifier: Apache-2.0
#include <unordered_map>
#include <utility>

#include "engine/graph/json_tree.h"

namespace engine {
namespace {

// A copy of a patch's value without the nulls in its objects.
JsonValue without_nulls(const JsonValue& patch, std::vector<Problem>& problems) {
  if (!patch.is(JsonValue::Kind::object)) return patch;
  JsonValue empty = patch;
  empty.members.clear();
  merge_patch(empty, patch, problems);
  return empty;
}

}  // namespace

void merge_patch(JsonValue& target, const JsonValue& patch, std::vector<Problem>& problems) {
  if (!patch.is(JsonValue::Kind::object)) {
    target = patch;
    return;
  }
  if (!target.is(JsonValue::Kind::object)) {
    target = patch;
    target.members.clear();
  }
  std::unordered_map<std::string_view, std::size_t> index;
  for (std::size_t i = 0; i < target.members.size(); ++i) index.emplace(target.members[i].key, i);
  std::vector<bool> removed(target.members.size(), false);
  std::vector<JsonMember> added;
  for (const JsonMember& member : patch.members) {
    const auto known = index.find(member.key);
    if (member.value.is(JsonValue::Kind::null)) {
      if (known != index.end()) {
        removed[known->second] = true;
      } else {
        std::vector<std::string> names;
        for (const JsonMember& other : target.members) names.push_back(other.key);
        problems.push_back({member.place(), "null removes " + quoted_text(member.key) +
                                                ", but there is none in the graph that is extended" +
                                                did_you_mean(member.key, names)});
      }
    } else if (known == index.end()) {
      added.push_back(member);
      added.back().value = without_nulls(member.value, problems);
    } else if (JsonMember& own = target.members[known->second];
               own.value.is(JsonValue::Kind::object) && member.value.is(JsonValue::Kind::object)) {
      merge_patch(own.value, member.value, problems);
    } else {
      own = member;
      own.value = without_nulls(member.value, problems);
    }
  }
  std::vector<JsonMember> merged;
  for (std::size_t i = 0; i < target.members.size(); ++i)
    if (!removed[i]) merged.push_back(std::move(target.members[i]));
  for (JsonMember& member : added) merged.push_back(std::move(member));
  target.members = std::move(merged);
}

}  // namespace engine
