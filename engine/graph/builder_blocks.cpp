// SPDX-License-Identifier: Apache-2.0
// The run block and the overrides of a node.
#include "engine/graph/builder.h"
#include "engine/graph/param_value.h"
#include "engine/graph/reference.h"

namespace engine {
namespace {

using Kind = JsonValue::Kind;

}  // namespace

void Builder::read_run(const JsonValue& tree, RunSettings* run) {
  const JsonMember* const block = tree.find("run");
  if (block == nullptr || !check_object(block->value, {"memory", "timeout_s"}, "the run block")) return;
  if (const JsonMember* const memory = block->value.find("memory")) {
    const std::int64_t bytes = memory->value.is(Kind::string) ? parse_size(memory->value.text).value_or(0) : 0;
    if (bytes == 0)
      problem(memory->value.place(),
              "found " + found(memory->value) + ", expected an amount above 0, such as " + std::string(size_examples));
    if (run != nullptr) run->memory_bytes = bytes;
  }
  if (const JsonMember* const timeout = block->value.find("timeout_s")) {
    const bool number = timeout->value.is(Kind::integer) || timeout->value.is(Kind::real);
    if (!number || !(timeout->value.real > 0))
      problem(timeout->value.place(), "found " + found(timeout->value) + ", expected a number of seconds above 0");
    if (run != nullptr && number) run->timeout_s = timeout->value.real;
  }
}

void Builder::read_overrides(int index, const JsonValue& overrides, FlatNode& node) {
  if (!overrides.is(Kind::object)) {
    problem(overrides.place(),
            "found " + found(overrides) + ", expected an object of element ids and parameters: {\"17-23,40\": {...}}");
    return;
  }
  std::vector<std::string> names;
  for (const ParamInfo& param : node.info->params) names.push_back(param.name);
  for (const JsonMember& member : overrides.members) {
    Override override;
    override.text = member.key;
    override.place = member.place();
    std::string error;
    if (!parse_ranges(member.key, override.ranges, error)) {
      problem(member.place(), error);
      continue;
    }
    if (!member.value.is(Kind::object) || member.value.members.empty()) {
      problem(member.value.place(), "found " +
                                        (member.value.is(Kind::object) ? "an empty object" : found(member.value)) +
                                        ", expected an object of parameters");
      continue;
    }
    for (const JsonMember& given : member.value.members) {
      const int param = node.info->find_param(given.key);
      ParamValue value;
      if (param < 0)
        problem(given.place(), "'" + node.info->name + "' has no parameter " + quoted_text(given.key) +
                                   did_you_mean_of(given.key, names));
      else if (read_value(index, given.value, node.info->params[param], value))
        override.params.emplace_back(param, std::move(value));
    }
    node.overrides.push_back(std::move(override));
  }
}

}  // namespace engine
