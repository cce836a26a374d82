// SPDX-License-Identifier: Apache-2.0
// The sweep block: what is varied must be there, and every value must be one that it can have.
#include <algorithm>

#include "engine/graph/builder.h"
#include "engine/graph/metric.h"
#include "engine/graph/param_value.h"

namespace engine {
namespace {

using Kind = JsonValue::Kind;

// As --set takes it.
std::string setting_of(const JsonValue& value) {
  if (value.is(Kind::boolean)) return value.boolean ? "true" : "false";
  if (!value.is(Kind::array)) return value.text;
  std::string text = "[";
  for (const JsonValue& item : value.items)
    text += (text.size() > 1 ? "," : "") + (item.is(Kind::string) ? to_text(item.text) : setting_of(item));
  return text + "]";
}

}  // namespace

void Builder::read_sweep(const JsonValue& tree, SweepSettings& sweep) {
  const JsonMember* const block = tree.find("sweep");
  if (block == nullptr || !check_object(block->value, {"vary", "metric"}, "the sweep block")) return;
  if (const JsonMember* const vary = block->value.find("vary")) {
    if (!vary->value.is(Kind::object)) {
      problem(vary->value.place(), "found " + found(vary->value) + ", expected an object: {\"node.param\": [1, 2]}");
    } else {
      std::map<std::string, std::vector<std::string>> swapped;  // kinds that a node is to be, by its id
      for (const JsonMember& member : vary->value.members)
        if (member.key.ends_with(".node"))
          for (const JsonValue& kind : member.value.items)
            swapped[member.key.substr(0, member.key.size() - 5)].push_back(kind.text);
      for (const JsonMember& member : vary->value.members) {
        SweepSettings::Vary read;
        if (read_variation(member, swapped[member.key.substr(0, member.key.find_last_of('.'))], read))
          sweep.vary.push_back(std::move(read));
      }
    }
  }
  const JsonMember* const metric = block->value.find("metric");
  if (metric == nullptr) return;
  const bool one = metric->value.is(Kind::string);
  if (!one && (!metric->value.is(Kind::array) || metric->value.items.empty()))
    return problem(metric->value.place(),
                   "found " + found(metric->value) + ", expected NODE.OUTPUT, or a list of such texts");
  for (const JsonValue& item : one ? std::vector<JsonValue>{metric->value} : metric->value.items) {
    Metric parsed;
    std::string error;
    if (!item.is(Kind::string)) {
      problem(item.place(), "found " + found(item) + ", expected NODE.OUTPUT");
      continue;
    }
    if (!parse_metric(item.text, parsed, error)) {
      problem(item.place(), error);
      continue;
    }
    const auto node = std::find_if(nodes_.begin(), nodes_.end(),
                                   [&](const FlatNode& other) { return other.id == parsed.reference.node; });
    std::vector<std::string> names;
    for (const FlatNode& other : nodes_) names.push_back(other.id);
    if (node == nodes_.end()) {
      problem(item.place(),
              "the graph has no node '" + parsed.reference.node + "'" + did_you_mean(parsed.reference.node, names));
    } else if (node->info != nullptr && !parsed.reference.output.empty() &&
               node->info->find_output(parsed.reference.output) < 0 && find_setting(node->id, "node") == nullptr) {
      names.clear();
      for (const OutputInfo& output : node->info->outputs) names.push_back(output.name);
      problem(item.place(), "'" + node->info->name + "' has no output '" + parsed.reference.output + "'" +
                                did_you_mean_of(parsed.reference.output, names));
    }
    sweep.metrics.push_back(item.text);
  }
}

bool Builder::read_variation(const JsonMember& member, const std::vector<std::string>& swapped,
                             SweepSettings::Vary& vary) {
  const JsonValue& values = member.value;
  if (!values.is(Kind::array) || values.items.empty()) {
    problem(values.place(), "found " + (values.is(Kind::array) ? "an empty list" : found(values)) +
                                ", expected a list of the values to try");
    return false;
  }
  vary.name = member.key;
  const std::size_t dot = member.key.find_last_of('.');
  const std::string owner = dot == std::string::npos ? "" : member.key.substr(0, dot);
  const std::string name = dot == std::string::npos ? member.key : member.key.substr(dot + 1);
  const auto add = [&](const JsonValue& value, bool path) {
    vary.shown.push_back(setting_of(value));
    vary.values.push_back(path ? resolve_path(*value.source, value.text) : vary.shown.back());
  };

  for (const Scope& scope : scopes_) {
    if (scope.prefix != (owner.empty() ? "" : owner + "/")) continue;
    const auto param = scope.params.find(name);
    if (param == scope.params.end()) {
      problem(member.place(), "the graph" + (owner.empty() ? "" : " of '" + owner + "'") + " has no parameter '" +
                                  name + "'" + did_you_mean_of(name, keys_of(scope.params)));
      return false;
    }
    const BoundParam& bound = param->second;
    for (const JsonValue& value : values.items) {
      std::string error;
      if (bound.path && (!value.is(Kind::string) || value.text.empty()))
        error = "found " + found(value) + ", expected a path";
      else
        read_param(value, bound.type, error);
      if (!error.empty()) problem(value.place(), error);
      add(value, bound.path && value.is(Kind::string));
    }
    return true;
  }

  const auto node =
      std::find_if(nodes_.begin(), nodes_.end(), [&](const FlatNode& other) { return other.id == owner; });
  if (node == nodes_.end()) {
    std::vector<std::string> names;
    for (const FlatNode& other : nodes_) names.push_back(other.id);
    problem(member.place(), "the graph has no node '" + owner + "'" + did_you_mean(owner, names));
    return false;
  }
  if (name == "node") {
    for (const JsonValue& value : values.items) {
      if (!value.is(Kind::string))
        problem(value.place(), "found " + found(value) + ", expected the name of a node");
      else
        find_kind(value.text, value.place());
      add(value, false);
    }
    return true;
  }
  // The node's own kind, and those that take its place in this sweep.
  std::vector<const NodeInfo*> kinds;
  if (node->info != nullptr) kinds.push_back(node->info);
  for (const std::string& kind : swapped)
    if (const NodeInfo* const info = context_.find_node(kind)) kinds.push_back(info);
  std::vector<const ParamInfo*> params;
  std::vector<std::string> names;
  for (const NodeInfo* kind : kinds)
    for (const ParamInfo& param : kind->params) {
      names.push_back(param.name);
      if (param.name == name) params.push_back(&param);
    }
  if (params.empty()) {
    // Not the fault of the block where a setting has put another kind of node in place.
    if (!kinds.empty() && find_setting(owner, "node") == nullptr)
      problem(member.place(),
              "the node '" + owner + "' has no parameter '" + name + "'" + did_you_mean_of(name, names));
    return false;
  }
  for (const JsonValue& value : values.items) {
    std::string error, first;
    const bool fits = std::any_of(params.begin(), params.end(), [&](const ParamInfo* param) {
      error.clear();
      const bool taken = read_param(value, *param, error).has_value();
      if (first.empty()) first = error;
      return taken;
    });
    if (!fits) problem(value.place(), first);
    add(value, false);
  }
  return true;
}

}  // namespace engine
