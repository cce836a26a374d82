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

// The variants that can be run, and the nodes that their metrics look at.
struct Sound {
  std::vector<Variant*> variants;
  std::vector<const Graph*> graphs;
  std::vector<std::vector<int>> targets;
};

// Those that cannot say why.
Sound sound_ones(std::vector<Variant>& variants, const std::vector<Metric>& metrics) {
  Sound sound;
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
    sound.variants.push_back(&variant);
    sound.graphs.push_back(&variant.graph);
    sound.targets.push_back(std::move(wanted));
  }
  return sound;
}

// What became of a node of the merged graph.
struct Fate {
  std::string failure;  // of the element that failed first
  bool blocked = false;
  double seconds = 0;
  std::size_t run = 0, reused = 0;

  void note(const RunEvent& event) {
    using Kind = RunEvent::Kind;
    if (event.kind == Kind::failed && failure.empty()) failure = event.text;
    if (event.kind == Kind::blocked) blocked = true;
    if (event.kind == Kind::finished || event.kind == Kind::made) seconds += event.seconds;
    run += event.kind == Kind::finished;
    reused += event.kind == Kind::reused;
  }
};

// What each variant's share of the run came to. Says of one whose metrics cannot be read why. fates: of the merged
// nodes; node_of: the merged node of each of the variant's.
void settle(const Graph& merged, const std::vector<Fate>& fates, const std::vector<int>& node_of,
            const std::vector<int>& targets, Variant& variant) {
  const auto fate_of = [&](std::size_t node) -> const Fate& { return fates[static_cast<std::size_t>(node_of[node])]; };
  std::string failure;
  for (std::size_t n = 0; n < node_of.size(); ++n) {
    const Fate& fate = fate_of(n);
    variant.seconds += fate.seconds;
    variant.run += fate.run;
    variant.reused += fate.reused;
    if (failure.empty() && !fate.failure.empty())
      failure = without_number(fate.failure, merged.nodes[static_cast<std::size_t>(node_of[n])].id,
                               variant.graph.nodes[n].id);
  }
  // Elements may fail that a metric does not look at.
  for (const int target : targets) {
    const Fate& fate = fate_of(static_cast<std::size_t>(target));
    if (fate.blocked || !fate.failure.empty())
      variant.failure = failure.empty() ? "what its metric needs has failed" : failure;
  }
}

void read_metrics(const std::vector<Metric>& metrics, Plugins& plugins, Store& store, const RunOptions& options,
                  Variant& variant) {
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
      return;
    }
  }
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
  const Sound sound = sound_ones(variants, metrics);
  SweepResult result;
  if (sound.variants.empty()) return result;
  const MergedGraphs merged = merge_graphs(sound.graphs, sound.targets);
  std::unordered_map<std::string, std::size_t> index_of;
  for (std::size_t n = 0; n < merged.graph.nodes.size(); ++n) index_of.emplace(merged.graph.nodes[n].id, n);
  std::vector<Fate> fates(merged.graph.nodes.size());
  RunOptions together = options;
  together.out_folder.clear();
  together.to.clear();
  together.elements.clear();
  together.fail_fast = false;
  together.observer = [&](const RunEvent& event) {
    if (const auto node = index_of.find(event.node); node != index_of.end()) fates[node->second].note(event);
    if (options.observer) options.observer(event);
  };
  const RunResult ran = run_graph(merged.graph, plugins, store, together);
  result.tasks = ran.tasks;
  result.seconds = ran.seconds;
  result.cancelled = ran.cancelled;
  for (std::size_t v = 0; v < sound.variants.size(); ++v) {
    Variant& variant = *sound.variants[v];
    settle(merged.graph, fates, merged.node_of[v], sound.targets[v], variant);
    if (ran.cancelled) variant.failure = "the sweep was stopped";
    if (variant.failure.empty()) read_metrics(metrics, plugins, store, options, variant);
  }
  return result;
}

}  // namespace engine
