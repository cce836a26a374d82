// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/digest.h"
#include "engine/graph/graph.h"
#include "engine/plugin/plugins.h"
#include "engine/store/store.h"
#include "engine/value/value.h"

namespace engine {

// What happens in a run, as it happens. Times are seconds since the run's start.
struct RunEvent {
  // made: a cheap task ended, whose values are not stored and which is not counted.
  enum class Kind { started, finished, made, reused, failed, blocked, warning, progress };
  Kind kind = Kind::started;
  double time_s = 0;
  std::string node;          // "flow"
  std::string type;          // "flow.robust"
  std::string element;       // "17", "take03/17", or empty
  std::string text;          // failed, warning: the message
  double seconds = 0;        // finished, made: how long it took
  std::uint32_t worker = 0;  // number of the thread that runs the task, from 1; 0 where none does
  double fraction = 0;       // progress of one task, in [0, 1]
  std::size_t done = 0;      // tasks settled so far, and known so far
  std::size_t known = 0;
};
// Called with the run's lock held by whatever thread: return quickly.
using RunObserver = std::function<void(const RunEvent&)>;

struct RunOptions {
  int threads = 0;                // 0 = as many as the machine has
  std::int64_t memory_bytes = 0;  // budget for values in memory; 0 = the graph's, else half of what is free
  bool fail_fast = false;
  std::string to;                        // run only what this node needs; the graph's outputs are not published
  std::vector<std::string> elements;     // with `to`: ids and ranges of ids ("0-49", "take03")
  std::string out_folder;                // outputs are published here; empty = nowhere
  std::function<bool()> stop_requested;  // asked often; true ends the run
  std::function<void()> abandon;         // called when a task does not end 0.7 s after a stop: leave the process here
  RunObserver observer;
};

struct RunCounts {
  std::size_t run = 0, reused = 0, failed = 0, blocked = 0;
};

struct RunResult {
  RunCounts tasks;
  double seconds = 0;
  bool cancelled = false;
  std::vector<std::string> failures;   // one message each, with node, element and key
  std::vector<std::string> published;  // paths written or found unchanged
};

// Runs what the graph's outputs need. Throws EngineError and PluginError for what concerns the whole run.
RunResult run_graph(const Graph& graph, Plugins& plugins, Store& store, const RunOptions& options);

// What a run would do. Nothing is run or written but the memo of file digests.
struct PlannedTask {
  enum class Fate { cached, runs, may_run, unknown_length };
  Fate fate = Fate::cached;
  std::string node, type, element;
  std::string depends_on;  // may_run, unknown_length: "frames[17]"
};
struct Plan {
  std::vector<PlannedTask> tasks;  // in graph order
  std::size_t cached = 0, runs = 0, may_run = 0;
};
Plan plan_graph(const Graph& graph, Plugins& plugins, Store& store);

// Why the tasks of a node (or one element of it) would rerun: true leaf causes, against the last run of this graph
// file.
struct Cause {
  std::string task;               // "sharpen[17]": the task where the change enters
  std::string what;               // "parameter levels: 5 -> 6", "file clip.mpg changed", "plugin toy changed"
  std::vector<std::string> path;  // tasks from the cause to the one asked about
  std::size_t others = 0;         // further elements of the node with the same change
};
struct Explanation {
  std::string task;
  PlannedTask::Fate fate = PlannedTask::Fate::cached;
  bool seen_before = false;  // this graph file ran it before
  std::vector<Cause> causes;
};
std::vector<Explanation> explain_node(const Graph& graph, Plugins& plugins, Store& store, const std::string& node,
                                      const std::string& element);

// Runs a sample of the tasks that the store has of a graph again and compares. `differing`: a message for each whose
// result is another now, or which failed, with node, element and key. The same seed chooses the same tasks.
struct AuditResult {
  std::size_t stored = 0, checked = 0;
  std::vector<std::string> differing;
};
AuditResult audit_graph(const Graph& graph, Plugins& plugins, Store& store, double fraction, std::uint64_t seed,
                        const RunOptions& options);

// The digests of everything that a graph's stored results are made of, for pinning.
std::vector<Digest> values_of(const Graph& graph, Plugins& plugins, Store& store);

// The value of one output of a node (one element of it), computing what is needed.
struct GotValue {
  Value value;
  Digest identity;
};
GotValue get_value(const Graph& graph, Plugins& plugins, Store& store, const Reference& reference,
                   const RunOptions& options);

}  // namespace engine
