// SPDX-License-Identifier: Apache-2.0
#include "engine/run/sweep.h"

#include <map>
#include <set>
#include <stdexcept>
#include <unordered_map>

namespace engine {
namespace {

// Everything that a node's results depend on within one sweep, inputs by their merged nodes.
std::string identity_of(const GraphNode& node, const std::vector<int>& merged) {
  std::string text = node.info->name;
  const auto add = [&](const std::string& part) { text += '\n' + std::to_string(part.size()) + ' ' + part; };
  for (const ParamValue& param : node.params) add(to_text(param));
  for (const Override& override : node.overrides) {
    add(override.text);
    for (const auto& [index, value] : override.params) add(std::to_string(index) + " " + to_text(value));
  }
  for (const auto& port : node.inputs) {
    add("port");
    for (const Source& source : port) {
      add(std::to_string(static_cast<int>(source.kind)));
      if (source.kind == Source::Kind::file) add(source.path);
      if (source.kind != Source::Kind::node) continue;
      add(std::to_string(merged[static_cast<std::size_t>(source.node)]) + " " + std::to_string(source.output));
      for (const std::string& id : source.element) add(id);
    }
  }
  return text;
}

// "flow#2[17] (flow.dis): why" as the variant that has it alone would say it.
std::string without_number(const std::string& text, const std::string& merged, const std::string& own) {
  return text.starts_with(merged) ? own + text.substr(merged.size()) : text;
}

}  // namespace

std::vector<std::vector<Setting>> combinations(const std::vector<SweepSettings::Vary>& vary) {
  std::vector<std::vector<Setting>> all = {{}};
  for (const SweepSettings::Vary& one : vary) {
    std::vector<std::vector<Setting>> longer;
    for (const auto& settings : all)
      for (const std::string& value : one.values) {
        longer.push_back(settings);
        longer.back().push_back({one.name, value});
      }
    all = std::move(longer);
  }
  return all;
}

MergedGraphs merge_graphs(const std::vector<const Graph*>& graphs, const std::vector<std::vector<int>>& targets) {
  MergedGraphs result;
  Graph& merged = result.graph;
  std::unordered_map<std::string, int> known;
  std::set<std::string> names;
  for (std::size_t g = 0; g < graphs.size(); ++g) {
    const Graph& graph = *graphs[g];
    if (g == 0) {
      merged.path = graph.path + "#sweep";  // the index tells it from runs of the graph itself
      merged.run = graph.run;
    }
    std::vector<int>& node_of = result.node_of.emplace_back();
    for (const GraphNode& node : graph.nodes) {
      const auto [at, fresh] = known.emplace(identity_of(node, node_of), static_cast<int>(merged.nodes.size()));
      node_of.push_back(at->second);
      if (!fresh) continue;
      GraphNode& copy = merged.nodes.emplace_back(node);
      copy.needed = false;
      for (int number = 2; !names.insert(copy.id).second; ++number) copy.id = node.id + "#" + std::to_string(number);
      for (auto& port : copy.inputs)
        for (Source& source : port)
          if (source.kind == Source::Kind::node) source.node = node_of[static_cast<std::size_t>(source.node)];
    }
    for (const int target : targets[g])
      merged.nodes[static_cast<std::size_t>(node_of[static_cast<std::size_t>(target)])].needed = true;
  }
  for (std::size_t n = merged.nodes.size(); n-- > 0;) {
    if (!merged.nodes[n].needed) continue;
    for (const auto& port : merged.nodes[n].inputs)
      for (const Source& source : port) {
        if (source.kind == Source::Kind::node) merged.nodes[static_cast<std::size_t>(source.node)].needed = true;
        if (merged.nodes[n].info->structural == Structural::first) break;
      }
  }
  return result;
}

SweepResult run_sweep(std::vector<Variant>& variants, const std::vector<Metric>& metrics, Plugins& plugins,
                      Store& store, const RunOptions& options) {
  std::vector<Variant*> sound;
  std::vector<const Graph*> graphs;
  std::vector<std::vector<int>> targets;
  for (Variant& variant : variants) {
    if (!variant.problems.empty()) {
      variant.failure = variant.problems.front().line();
      continue;
    }
    std::vector<int> wanted;
    for (const Metric& metric : metrics) {
      const int node = variant.graph.find_node(metric.reference.node);
      if (node < 0 && variant.failure.empty())
        variant.failure = "the graph has no node '" + metric.reference.node + "' with these settings";
      wanted.push_back(node);
    }
    if (!variant.failure.empty()) continue;
    sound.push_back(&variant);
    graphs.push_back(&variant.graph);
    targets.push_back(std::move(wanted));
  }
  SweepResult result;
  if (sound.empty()) return result;
  const MergedGraphs merged = merge_graphs(graphs, targets);

  std::unordered_map<std::string, int> index_of;
  for (std::size_t n = 0; n < merged.graph.nodes.size(); ++n)
    index_of.emplace(merged.graph.nodes[n].id, static_cast<int>(n));
  struct Fate {
    std::string failure;
    bool blocked = false;
    double seconds = 0;
    std::size_t run = 0, reused = 0;
  };
  std::vector<Fate> fates(merged.graph.nodes.size());
  RunOptions together = options;
  together.out_folder.clear();
  together.to.clear();
  together.elements.clear();
  together.fail_fast = false;
  together.observer = [&](const RunEvent& event) {
    if (const auto node = index_of.find(event.node); node != index_of.end()) {
      Fate& fate = fates[static_cast<std::size_t>(node->second)];
      using Kind = RunEvent::Kind;
      if (event.kind == Kind::failed && fate.failure.empty()) fate.failure = event.text;
      if (event.kind == Kind::blocked) fate.blocked = true;
      if (event.kind == Kind::finished || event.kind == Kind::made) fate.seconds += event.seconds;
      fate.run += event.kind == Kind::finished;
      fate.reused += event.kind == Kind::reused;
    }
    if (options.observer) options.observer(event);
  };
  const RunResult ran = run_graph(merged.graph, plugins, store, together);
  result.tasks = ran.tasks;
  result.seconds = ran.seconds;
  result.cancelled = ran.cancelled;

  for (std::size_t v = 0; v < sound.size(); ++v) {
    Variant& variant = *sound[v];
    const std::vector<int>& node_of = merged.node_of[v];
    std::string failure;
    for (std::size_t n = 0; n < node_of.size(); ++n) {
      const auto at = static_cast<std::size_t>(node_of[n]);
      const Fate& fate = fates[at];
      variant.seconds += fate.seconds;
      variant.run += fate.run;
      variant.reused += fate.reused;
      if (failure.empty() && !fate.failure.empty())
        failure = without_number(fate.failure, merged.graph.nodes[at].id, variant.graph.nodes[n].id);
    }
    if (ran.cancelled) {
      variant.failure = "the sweep was stopped";
      continue;
    }
    // Elements may fail that a metric does not look at.
    bool stopped = false;
    for (const int target : targets[v]) {
      const Fate& fate = fates[static_cast<std::size_t>(node_of[static_cast<std::size_t>(target)])];
      stopped |= fate.blocked || !fate.failure.empty();
    }
    if (stopped) {
      variant.failure = failure.empty() ? "what its metric needs has failed" : failure;
      continue;
    }
    for (const Metric& metric : metrics) {
      Graph graph = variant.graph;
      graph.path += "#sweep";
      try {
        RunOptions quiet;
        quiet.threads = options.threads;
        quiet.memory_bytes = options.memory_bytes;
        quiet.stop_requested = options.stop_requested;
        const Value value = get_value(graph, plugins, store, metric.reference, quiet).value;
        variant.values.push_back(number_at(value.type().show(value.data().get()), metric.path));
      } catch (const std::exception& error) {
        variant.failure = error.what();
        variant.values.clear();
        break;
      }
    }
  }
  return result;
}

}  // namespace engine
