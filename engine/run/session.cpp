// SPDX-License-Identifier: Apache-2.0
#include "engine/run/session.h"

#include <unistd.h>

#include <algorithm>

namespace engine::run {
namespace {

std::int64_t half_of_memory() {
  return static_cast<std::int64_t>(::sysconf(_SC_PHYS_PAGES)) * ::sysconf(_SC_PAGESIZE) / 2;
}

}  // namespace

Session::Session(const Graph& graph, Plugins& plugins, Store& store, const RunOptions& options, Mode mode)
    : graph_(graph), plugins_(plugins), store_(store), options_(options), mode_(mode), filter_(options.elements) {
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  most_workers_ = options.threads > 0 ? options.threads : static_cast<int>(cores);
  budget_ = options.memory_bytes > 0 ? options.memory_bytes
            : graph.run.memory_bytes > 0 ? graph.run.memory_bytes : half_of_memory();
}

Session::~Session() { join_workers(); }

void Session::finish_run(RunResult& result) {
  const std::lock_guard guard(mutex_);
  result.tasks = counts_;
  result.failures = failures_;
  result.cancelled = stopped_ && failures_.empty();
  result.seconds = now();
  if (!filter_.empty()) return;
  // What stood behind every element, for explain.
  std::map<int, NodeHistory> histories;
  for (const Task& task : tasks_)
    if (!task.key.empty()) histories[task.node].entries.push_back({task.element, task.key});
  for (auto& [index, history] : histories) {
    history.parts = shared_parts(index);
    store_.set_history(graph_.path, node(index).id, history);
  }
  store_.flush();
}

}  // namespace engine::run
