// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "engine/graph/graph.h"
#include "engine/graph/metric.h"
#include "engine/run/run.h"

namespace engine {

// Every combination of what is varied, the last one varying fastest. A combination has one setting for each.
std::vector<std::vector<Setting>> combinations(const std::vector<SweepSettings::Vary>& vary);

// Graphs laid over each other: nodes that do the same on the same inputs are there once, so that one run makes each
// result once, those of cheap nodes included. node_of[g][n] is the merged node of graph g's node n. Needed is what the
// targets need (a list of nodes per graph). The merged graph has no outputs; a node that is not the same in all graphs
// is called "flow#2".
struct MergedGraphs {
  Graph graph;
  std::vector<std::vector<int>> node_of;
};
MergedGraphs merge_graphs(const std::vector<const Graph*>& graphs, const std::vector<std::vector<int>>& targets);

// What a graph with one combination of settings came to.
struct Variant {
  std::vector<Setting> settings;
  Graph graph;
  std::vector<Problem> problems;  // the graph is invalid with these settings; nothing of it was run

  std::vector<double> values;       // of the metrics, as many as there are; empty where it failed
  std::string failure;              // why it has no values; empty = it has them
  double seconds = 0;               // of its tasks that were run now; tasks that it shares with others count for each
  std::size_t run = 0, reused = 0;  // its tasks in this sweep
};

struct SweepResult {
  RunCounts tasks;  // of all together: what is shared counts once
  double seconds = 0;
  bool cancelled = false;
};

// Runs what the metrics of all variants need, and reads them. A variant that is invalid, fails, or lacks a metric is
// told in its `failure`; the others go on.
SweepResult run_sweep(std::vector<Variant>& variants, const std::vector<Metric>& metrics, Plugins& plugins,
                      Store& store, const RunOptions& options);

}  // namespace engine
