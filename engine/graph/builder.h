// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/graph/documents.h"
#include "engine/graph/flat_graph.h"
#include "engine/graph/graph.h"

namespace engine {

// A parameter of a graph with the value that it has in this run.
struct BoundParam {
  ParamInfo type;  // kind string for a path
  bool path = false, optional = false;
  bool broken = false;               // declared wrongly or without a value, which is reported
  const JsonValue* value = nullptr;  // null = unset; knows where it was written
  std::string setting;               // what --set calls it: "levels", "stabilise.levels"
};

// One use of a graph file: the graph itself, or an embedded subgraph.
struct Scope {
  enum class State { open, under_way, done };
  struct Entry {
    bool subgraph = false;
    int index = -1;  // in the scopes, or in the nodes
  };
  struct Input {
    std::string type;
    int depth = 0;
    const JsonValue* given = nullptr;  // what the embedding graph connects; null = nothing
    State state = State::open;
    Link link;
  };
  struct Output {
    const JsonMember* member = nullptr;
    State state = State::open;
    Link link;
  };
  const GraphFile* file = nullptr;
  int parent = -1;
  std::string prefix;  // of its node ids: "", "stabilise/"
  bool usable = true;  // false: its file could not be read, so nothing is said about references to it
  std::unordered_map<std::string, Entry> entries;
  std::vector<std::string> entry_names;
  std::map<std::string, BoundParam> params;
  std::map<std::string, Input> inputs;
  std::map<std::string, Output> outputs;
};

// Turns files and settings into a flat graph.
class Builder {
 public:
  Builder(const GraphContext& context, const std::vector<Setting>& settings, const std::string& folder,
          std::vector<Problem>& problems);
  FlatGraph build(const GraphFile& file, Graph& graph);

 private:
  struct Given {  // a setting
    std::string name, value, pointer;
    bool used = false;
  };
  struct Deferred {  // a node whose inputs are linked when all nodes are known
    int node, scope;
    const JsonMember* member;
  };

  // builder.cpp
  int add_scope(const GraphFile& file, int parent, const std::string& prefix, const JsonMember* embedding);
  void read_nodes(int scope);
  void read_node(int scope, const JsonMember& member);
  const NodeInfo* find_kind(const std::string& name, const Place& place);
  void read_subgraph(int scope, const JsonMember& member, const JsonValue& graph);
  void read_inputs(int scope, const JsonMember* embedding);
  void read_outputs(int scope);

  // builder_blocks.cpp
  void read_run(const JsonValue& tree, RunSettings* run);
  void read_overrides(int scope, const JsonValue& overrides, FlatNode& node);

  // builder_sweep.cpp
  void read_sweep(const JsonValue& tree, SweepSettings& sweep);
  void read_variations(const JsonValue& vary, SweepSettings& sweep);
  bool read_variation(const JsonMember& member, const std::vector<std::string>& swapped, SweepSettings::Vary& vary);
  bool vary_graph(const Scope& scope, const std::string& owner, const std::string& name, const JsonMember& member,
                  SweepSettings::Vary& vary);
  bool vary_node(const FlatNode& node, const std::string& name, const std::vector<std::string>& swapped,
                 const JsonMember& member, SweepSettings::Vary& vary);
  static void add_variant(const JsonValue& value, bool is_path, SweepSettings::Vary& vary);
  void read_metrics(const JsonValue& metric, SweepSettings& sweep);
  void check_metric(const JsonValue& item, const Reference& reference);
  const FlatNode* find_node(const std::string& id) const;
  std::vector<std::string> node_ids() const;

  // builder_settings.cpp
  void read_settings(const std::vector<Setting>& settings);
  Given* find_setting(const std::string& node, const std::string& param);
  void report_unused_settings(FlatGraph& flat);

  // builder_params.cpp
  void read_params(int scope, const JsonMember* embedding);
  std::optional<BoundParam> declare_param(const JsonMember& member);
  void bind_param(int scope, BoundParam& bound, const JsonMember& declared, const JsonMember* embedding);
  void read_node_params(int scope, const JsonMember& member, FlatNode& node, bool swapped);
  bool read_value(int scope, const JsonValue& written, const ParamInfo& param, ParamValue& value);
  const BoundParam* find_param(int scope, const JsonValue& written);

  // builder_links.cpp
  void link_nodes();
  void link_outputs(FlatGraph& flat);
  Link link(int scope, const JsonValue& written);
  Link link_text(int scope, const JsonValue& written);
  Link link_param(int scope, const JsonValue& written);
  Link link_input(int scope, const JsonValue& written);
  Link link_file(const JsonValue& written);
  Link link_output(int scope, const std::string& name);
  Link broken(const Place& place, std::string text);

  // An object whose keys are all among those allowed; anything else is reported. False when it is no object.
  bool check_object(const JsonValue& value, const std::vector<std::string>& keys, const std::string& what);
  void problem(const Place& place, std::string text) { problems_.push_back({place, std::move(text)}); }

  const GraphContext& context_;
  std::vector<Problem>& problems_;
  Documents documents_;
  SourceFile command_line_;
  std::map<std::string, std::vector<Given>> settings_;  // by node id; "" = of the graph
  std::deque<JsonValue> typed_;                         // values of settings
  std::deque<Scope> scopes_;
  std::vector<Deferred> deferred_;
  std::vector<InputCheck> input_checks_;
  std::vector<FlatNode> nodes_;
  std::set<const JsonValue*> blamed_;  // values of parameters that a problem names already
  std::optional<std::vector<std::string>> node_types_;
  int link_depth_ = 0;
  std::vector<std::string> notes_;

 public:
  Documents& documents() { return documents_; }
};

template <class Map>
std::vector<std::string> keys_of(const Map& map) {
  std::vector<std::string> keys;
  for (const auto& entry : map) keys.push_back(entry.first);
  return keys;
}

// True for "${x}"; name gets the x.
bool is_substitution(const std::string& text, std::string& name);

// Which of some missing things are nobody's fault but a misspelt name's, so that one mistake is told once: the nearest
// ones, and as many more as there are misspelt names without a nearest one.
void forgive_missing(const std::vector<std::string>& misspelt, const std::vector<std::string>& names,
                     std::vector<std::string>& missing);

}  // namespace engine
