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
  if (const JsonMember* const vary = block->value.find("vary")) read_variations(vary->value, sweep);
  if (const JsonMember* const metric = block->value.find("metric")) read_metrics(metric->value, sweep);
}

void Builder::read_variations(const JsonValue& vary, SweepSettings& sweep) {
  if (!vary.is(Kind::object))
    return problem(vary.place(), "found " + found(vary) + ", expected an object: {\"node.param\": [1, 2]}");
  std::map<std::string, std::vector<std::string>> swapped;  // kinds that a node is to be, by its id
  for (const JsonMember& member : vary.members)
    if (member.key.ends_with(".node"))
      for (const JsonValue& kind : member.value.items)
        swapped[member.key.substr(0, member.key.size() - 5)].push_back(kind.text);
  for (const JsonMember& member : vary.members) {
    SweepSettings::Vary read;
    if (read_variation(member, swapped[member.key.substr(0, member.key.find_last_of('.'))], read))
      sweep.vary.push_back(std::move(read));
  }
}

void Builder::read_metrics(const JsonValue& metric, SweepSettings& sweep) {
  const bool one = metric.is(Kind::string);
  if (!one && (!metric.is(Kind::array) || metric.items.empty()))
    return problem(metric.place(), "found " + found(metric) + ", expected NODE.OUTPUT, or a list of such texts");
  for (const JsonValue& item : one ? std::vector<JsonValue>{metric} : metric.items) {
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
    check_metric(item, parsed.reference);
    sweep.metrics.push_back(item.text);
  }
}

void Builder::check_metric(const JsonValue& item, const Reference& reference) {
  const FlatNode* const node = find_node(reference.node);
  if (node == nullptr)
    return problem(item.place(),
                   "the graph has no node '" + reference.node + "'" + did_you_mean(reference.node, node_ids()));
  // Not the fault of the block where a setting has put another kind of node in place.
  if (node->info == nullptr || reference.output.empty() || node->info->find_output(reference.output) >= 0 ||
      find_setting(node->id, "node") != nullptr)
    return;
  std::vector<std::string> names;
  for (const OutputInfo& output : node->info->outputs) names.push_back(output.name);
  problem(item.place(), "'" + node->info->name + "' has no output '" + reference.output + "'" +
                            did_you_mean_of(reference.output, names));
}

const FlatNode* Builder::find_node(const std::string& id) const {
  const auto node = std::find_if(nodes_.begin(), nodes_.end(), [&](const FlatNode& other) { return other.id == id; });
  return node == nodes_.end() ? nullptr : &*node;
}

std::vector<std::string> Builder::node_ids() const {
  std::vector<std::string> ids;
  for (const FlatNode& node : nodes_) ids.push_back(node.id);
  return ids;
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
  for (const Scope& scope : scopes_)
    if (scope.prefix == (owner.empty() ? "" : owner + "/")) return vary_graph(scope, owner, name, member, vary);
  const FlatNode* const node = find_node(owner);
  if (node == nullptr) {
    problem(member.place(), "the graph has no node '" + owner + "'" + did_you_mean(owner, node_ids()));
    return false;
  }
  if (name != "node") return vary_node(*node, name, swapped, member, vary);
  for (const JsonValue& value : values.items) {
    if (!value.is(Kind::string))
      problem(value.place(), "found " + found(value) + ", expected the name of a node");
    else
      find_kind(value.text, value.place());
    add_variant(value, false, vary);
  }
  return true;
}

void Builder::add_variant(const JsonValue& value, bool is_path, SweepSettings::Vary& vary) {
  vary.shown.push_back(setting_of(value));
  vary.values.push_back(is_path ? resolve_path(*value.source, value.text) : vary.shown.back());
}

// A parameter of the graph, or of one that is embedded as owner.
bool Builder::vary_graph(const Scope& scope, const std::string& owner, const std::string& name,
                         const JsonMember& member, SweepSettings::Vary& vary) {
  const auto param = scope.params.find(name);
  if (param == scope.params.end()) {
    problem(member.place(), "the graph" + (owner.empty() ? "" : " of '" + owner + "'") + " has no parameter '" + name +
                                "'" + did_you_mean_of(name, keys_of(scope.params)));
    return false;
  }
  const BoundParam& bound = param->second;
  for (const JsonValue& value : member.value.items) {
    std::string error;
    if (bound.path && (!value.is(Kind::string) || value.text.empty()))
      error = "found " + found(value) + ", expected a path";
    else
      read_param(value, bound.type, error);
    if (!error.empty()) problem(value.place(), error);
    add_variant(value, bound.path && value.is(Kind::string), vary);
  }
  return true;
}

// A parameter of the node's own kind, or of one of those that take its place in this sweep.
bool Builder::vary_node(const FlatNode& node, const std::string& name, const std::vector<std::string>& swapped,
                        const JsonMember& member, SweepSettings::Vary& vary) {
  std::vector<const NodeInfo*> kinds;
  if (node.info != nullptr) kinds.push_back(node.info);
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
    if (!kinds.empty() && find_setting(node.id, "node") == nullptr)
      problem(member.place(),
              "the node '" + node.id + "' has no parameter '" + name + "'" + did_you_mean_of(name, names));
    return false;
  }
  for (const JsonValue& value : member.value.items) {
    std::string error, first;
    const bool fits = std::any_of(params.begin(), params.end(), [&](const ParamInfo* param) {
      error.clear();
      const bool taken = read_param(value, *param, error).has_value();
      if (first.empty()) first = error;
      return taken;
    });
    if (!fits) problem(value.place(), first);
    add_variant(value, false, vary);
  }
  return true;
}

}  // namespace engine
