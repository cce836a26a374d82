// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/builder.h"

#include <algorithm>

#include "engine/graph/output_name.h"
#include "engine/graph/param_value.h"
#include "engine/graph/reference.h"

namespace engine {
namespace {

using Kind = JsonValue::Kind;

// Subgraphs multiply: a small file must not ask for all memory, or exhaust the stack.
constexpr std::size_t most_nodes = 100000;
constexpr int most_nested = 64;

constexpr const char* what_a_name_is = "names are made of letters, digits and '_', and start with no digit";

// "Seq<Seq<x>>" is x at depth 2.
bool parse_type(std::string_view text, std::string& type, int& depth) {
  depth = 0;
  while (text.starts_with("Seq<") && text.ends_with('>')) {
    text = text.substr(4, text.size() - 5);
    ++depth;
  }
  type = text;
  return !text.empty() && text.find_first_of("<> ") == std::string_view::npos;
}

}  // namespace

void forgive_missing(const std::vector<std::string>& misspelt, const std::vector<std::string>& names,
                     std::vector<std::string>& missing) {
  std::size_t unclear = 0;
  for (const std::string& name : misspelt) {
    const std::string nearest = nearest_name(name, names);
    if (nearest.empty()) ++unclear;
    std::erase(missing, nearest);
  }
  missing.erase(missing.begin(), missing.begin() + static_cast<std::ptrdiff_t>(std::min(unclear, missing.size())));
}

Builder::Builder(const GraphContext& context, const std::vector<Setting>& settings, const std::string& folder,
                 std::vector<Problem>& problems)
    : context_(context), problems_(problems), documents_(problems) {
  command_line_.shown = "command line";
  command_line_.folder = folder;
  read_settings(settings);
}

FlatGraph Builder::build(const GraphFile& file, Graph& graph) {
  add_scope(file, -1, "", nullptr);
  read_run(file.tree, &graph.run);
  if (const JsonMember* const doc = file.tree.find("doc")) graph.doc = doc->value.text;
  for (const JsonMember& member : file.tree.members) {
    if (member.key != "params") continue;
    for (const JsonMember& declared : member.value.members) {
      const auto bound = scopes_[0].params.find(declared.key);
      if (bound == scopes_[0].params.end()) continue;
      const BoundParam& param = bound->second;
      graph.params.push_back(
          {param.type, param.path, param.optional, declared.value.find("default") != nullptr, param.value != nullptr});
    }
  }
  link_nodes();
  FlatGraph flat;
  link_outputs(flat);
  report_unused_settings(flat);
  read_sweep(file.tree, graph.sweep);
  graph.notes = std::move(notes_);
  flat.nodes = std::move(nodes_);
  flat.input_checks = std::move(input_checks_);
  return flat;
}

bool Builder::check_object(const JsonValue& value, const std::vector<std::string>& keys, const std::string& what) {
  if (!value.is(Kind::object)) {
    problem(value.place(), "found " + found(value) + ", expected " + what);
    return false;
  }
  for (const JsonMember& member : value.members)
    if (std::find(keys.begin(), keys.end(), member.key) == keys.end())
      problem(member.place(), "unknown key " + quoted_text(member.key) + did_you_mean(member.key, keys) + "; " + what +
                                  " has the keys " + listed(keys));
  return true;
}

int Builder::add_scope(const GraphFile& file, int parent, const std::string& prefix, const JsonMember* embedding) {
  const int index = static_cast<int>(scopes_.size());
  Scope& scope = scopes_.emplace_back();
  scope.file = &file;
  scope.parent = parent;
  scope.prefix = prefix;
  scope.usable = file.usable;
  if (!file.usable) return index;
  check_object(file.tree, {"facegraph", "doc", "extends", "params", "inputs", "nodes", "outputs", "run", "sweep", "layout"},
               "a graph");
  if (const JsonMember* doc = file.tree.find("doc"); doc != nullptr && !doc->value.is(Kind::string))
    problem(doc->value.place(), "found " + found(doc->value) + ", expected a text");
  if (parent >= 0) read_run(file.tree, nullptr);
  read_params(index, embedding);
  read_inputs(index, embedding);
  read_outputs(index);
  read_nodes(index);
  return index;
}

void Builder::read_inputs(int index, const JsonMember* embedding) {
  Scope& scope = scopes_[index];
  const JsonMember* const given = embedding != nullptr ? embedding->value.find("inputs") : nullptr;
  if (given != nullptr && !given->value.is(Kind::object)) {
    problem(given->value.place(), "found " + found(given->value) + ", expected an object of the subgraph's inputs");
    scope.usable = false;
    return;
  }
  std::vector<std::string> names, missing, misspelt;
  if (const JsonMember* const inputs = scope.file->tree.find("inputs")) {
    if (!inputs->value.is(Kind::object)) {
      problem(inputs->value.place(), "found " + found(inputs->value) + ", expected an object of names and types");
      scope.usable = false;
      return;
    }
    if (embedding == nullptr && !inputs->value.members.empty())
      problem(inputs->place(),
              "a graph with inputs is a part of other graphs: embed it with \"graph\"; files come in as parameters of "
              "type \"path\"");
    for (const JsonMember& member : inputs->value.members) {
      names.push_back(member.key);
      Scope::Input& input = scope.inputs[member.key];
      if (!is_name(member.key))
        problem(member.place(), quoted_text(member.key) + " is no name of an input: " + what_a_name_is);
      if (!member.value.is(Kind::string) || !parse_type(member.value.text, input.type, input.depth)) {
        problem(member.value.place(),
                "found " + found(member.value) + ", expected a type such as \"image\" or \"Seq<image>\"");
        input.type.clear();
        input.depth = 0;
      }
      if (embedding == nullptr) continue;
      if (const JsonMember* const connected = given != nullptr ? given->value.find(member.key) : nullptr)
        input.given = &connected->value;
      else
        missing.push_back(member.key);
    }
  }
  for (std::size_t i = 0; given != nullptr && i < given->value.members.size(); ++i) {
    const JsonMember& member = given->value.members[i];
    if (scope.inputs.count(member.key) != 0) continue;
    misspelt.push_back(member.key);
    const bool is_param = scope.params.count(member.key) != 0;
    problem(member.place(), scope.file->source.shown + " has no input " + quoted_text(member.key) +
                                (is_param ? "; it is one of its \"params\"" : did_you_mean_of(member.key, names)));
  }
  forgive_missing(misspelt, names, missing);
  for (const std::string& name : missing)
    problem(embedding->place(), "the input '" + name + "' of " + scope.file->source.shown + " is not connected");
}

void Builder::read_outputs(int index) {
  Scope& scope = scopes_[index];
  const JsonMember* const outputs = scope.file->tree.find("outputs");
  if (outputs == nullptr) {
    problem(scope.file->tree.place(), "the key \"outputs\" is missing: it says what the graph makes");
    scope.usable = false;
    return;
  }
  if (!outputs->value.is(Kind::object) || outputs->value.members.empty()) {
    problem(outputs->value.place(), "found " +
                                        (outputs->value.is(Kind::object) ? "an empty object" : found(outputs->value)) +
                                        ", expected an object of outputs: {\"name.txt\": \"node\"}");
    scope.usable = false;
    return;
  }
  std::map<std::string, const JsonMember*> lower;
  for (const JsonMember& member : outputs->value.members) {
    scope.outputs[member.key].member = &member;
    const bool inner_name = scope.parent >= 0 && is_name(member.key);
    if (const std::string error = inner_name ? "" : output_name_error(member.key); !error.empty())
      problem(member.place(), error);
    const auto [other, fresh] = lower.emplace(folded(member.key), &member);
    if (!fresh)
      problem(member.place(), "the outputs " + quoted_text(other->second->key) + " and " + quoted_text(member.key) +
                                  " differ in case only: some disks hold them as one file");
  }
}

void Builder::read_nodes(int index) {
  const JsonMember* const nodes = scopes_[index].file->tree.find("nodes");
  if (nodes == nullptr) {
    problem(scopes_[index].file->tree.place(), "the key \"nodes\" is missing");
    scopes_[index].usable = false;
    return;
  }
  if (!nodes->value.is(Kind::object)) {
    problem(nodes->value.place(), "found " + found(nodes->value) + ", expected an object of nodes");
    scopes_[index].usable = false;
    return;
  }
  for (const JsonMember& member : nodes->value.members) {
    if (!is_name(member.key))
      problem(member.place(), quoted_text(member.key) + " is no name of a node: " + what_a_name_is);
    scopes_[index].entry_names.push_back(member.key);
    if (nodes_.size() + scopes_.size() >= most_nodes) {
      problem(member.place(), "the graph has more than " + std::to_string(most_nodes) + " nodes");
      return;
    }
    read_node(index, member);
  }
}

void Builder::read_node(int index, const JsonMember& member) {
  const auto unknown = [&] {  // a node that nothing is known of, so that references to it are not reported as well
    scopes_[index].entries[member.key] = {false, static_cast<int>(nodes_.size())};
    FlatNode& node = nodes_.emplace_back();
    node.id = scopes_[index].prefix + member.key;
    node.place = member.place();
  };
  const JsonMember* const graph = member.value.find("graph");
  const JsonMember* const type = member.value.find("node");
  if (graph != nullptr && type == nullptr) {
    if (!check_object(member.value, {"graph", "inputs", "params"}, "a subgraph")) return unknown();
    return read_subgraph(index, member, graph->value);
  }
  if (!check_object(member.value, {"node", "inputs", "params", "overrides"}, "a node")) return unknown();
  if (type == nullptr) {
    std::vector<std::string> keys;
    for (const JsonMember& other : member.value.members) keys.push_back(other.key);
    if (nearest_name("node", keys).empty() && nearest_name("graph", keys).empty())
      problem(member.place(),
              "the key \"node\" is missing: it names the kind of node (or \"graph\" a subgraph's file)");
    return unknown();
  }
  if (!type->value.is(Kind::string)) {
    problem(type->value.place(), "found " + found(type->value) + ", expected the name of a node");
    return unknown();
  }
  Given* const swap = find_setting(scopes_[index].prefix + member.key, "node");
  if (swap != nullptr) swap->used = true;
  const NodeInfo* const info =
      find_kind(swap != nullptr ? swap->value : type->value.text,
                swap != nullptr ? Place{command_line_.shown, 0, 0, swap->pointer} : type->value.place());
  unknown();
  FlatNode& node = nodes_.back();
  if (info == nullptr) return;
  node.info = info;
  node.ports.resize(info->inputs.size());
  read_node_params(index, member, node, swap != nullptr);
  if (const JsonMember* const overrides = member.value.find("overrides")) read_overrides(index, overrides->value, node);
  deferred_.push_back({static_cast<int>(nodes_.size()) - 1, index, &member});
}

// Null for what is no node, which is reported.
const NodeInfo* Builder::find_kind(const std::string& name, const Place& place) {
  if (const NodeInfo* const info = context_.find_node(name)) return info;
  const std::string absent = context_.absent_plugin ? context_.absent_plugin(name) : std::string();
  if (!node_types_) node_types_ = context_.node_names ? context_.node_names() : std::vector<std::string>();
  problem(place, absent.empty() ? "no node is called " + quoted_text(name) + did_you_mean(name, *node_types_)
                                : "the node " + quoted_text(name) + " cannot be used: " + absent);
  return nullptr;
}

void Builder::read_subgraph(int index, const JsonMember& member, const JsonValue& graph) {
  Scope::Entry& entry = scopes_[index].entries[member.key];
  entry.subgraph = true;
  entry.index = static_cast<int>(scopes_.size());
  const std::string prefix = scopes_[index].prefix + member.key + "/";
  const auto unusable = [&] {
    Scope& scope = scopes_.emplace_back();
    scope.file = scopes_[index].file;
    scope.parent = index;
    scope.prefix = prefix;
    scope.usable = false;
  };
  if (!graph.is(Kind::string) || graph.text.empty()) {
    problem(graph.place(), "found " + found(graph) + ", expected the path of a graph file");
    return unusable();
  }
  const std::string path = resolve_path(*graph.source, graph.text);
  std::string ring;
  int nested = 0;
  for (int at = index; at >= 0; at = scopes_[at].parent) {
    if (++nested > most_nested) {
      problem(graph.place(), "subgraphs are nested deeper than " + std::to_string(most_nested) + " levels");
      return unusable();
    }
    ring = scopes_[at].file->source.shown + " embeds " + ring;
    if (scopes_[at].file->path != path) continue;
    problem(graph.place(), "a graph cannot embed itself: " + ring + scopes_[at].file->source.shown);
    return unusable();
  }
  add_scope(documents_.read(path, shown_path(*graph.source, graph.text), graph.place()), index, prefix, &member);
}

}  // namespace engine
