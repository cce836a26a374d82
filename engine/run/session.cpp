// SPDX-License-Identifier: Apache-2.0
#include "engine/run/session.h"

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string>

namespace engine::run {
namespace {

// Half of what is free or can be freed at once: others may need the machine's memory, too.
std::int64_t half_of_memory() {
  std::ifstream list("/proc/meminfo");
  std::string name, unit;
  for (std::int64_t kilobytes = 0; list >> name >> kilobytes && std::getline(list, unit);)
    if (name == "MemAvailable:") return kilobytes * 1024 / 2;
  return static_cast<std::int64_t>(::sysconf(_SC_PHYS_PAGES)) * ::sysconf(_SC_PAGESIZE) / 4;
}

}  // namespace

Session::Session(const Graph& graph, Plugins& plugins, Store& store, const RunOptions& options, Mode mode)
    : graph_(graph), plugins_(plugins), store_(store), options_(options), mode_(mode), filter_(options.elements) {
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  most_workers_ = options.threads > 0 ? options.threads : static_cast<int>(cores);
  budget_ = options.memory_bytes > 0     ? options.memory_bytes
            : graph.run.memory_bytes > 0 ? graph.run.memory_bytes
                                         : half_of_memory();
  paces_.resize(graph.nodes.size());
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    const NodeInfo* info = graph.nodes[n].info;
    paces_[n].simple =
        info && info->cheap && !info->prior && info->structural == Structural::none &&
        std::all_of(info->inputs.begin(), info->inputs.end(),
                    [](const InputInfo& i) { return i.depth == 0 && !i.window && i.type != "file"; }) &&
        std::all_of(info->outputs.begin(), info->outputs.end(), [](const OutputInfo& o) { return o.depth == 0; });
  }
}

Session::~Session() {
  stopped_ = true;
  join_workers();
}

std::size_t Session::choose_for_audit(double fraction, std::uint64_t seed) {
  const std::lock_guard guard(mutex_);
  // Each task is drawn by its own key: which others there are does not matter.
  const auto drawn = [&](const Task& task) {
    Bytes bytes;
    ByteWriter writer(bytes);
    writer.number(seed);
    writer.raw(task.key.bytes.data(), task.key.bytes.size());
    std::uint64_t number;
    std::memcpy(&number, digest_of(bytes).bytes.data(), sizeof number);
    return static_cast<double>(number >> 11) * 0x1.0p-53;
  };
  std::size_t stored = 0;
  std::vector<Task*> chosen;
  std::pair<double, Task*> first{2, nullptr};
  for (Task& task : tasks_) {
    if (node(task.node).info->cheap || task.state != Task::State::known) continue;
    ++stored;
    const double number = drawn(task);
    if (number < first.first) first = {number, &task};
    if (number < fraction) chosen.push_back(&task);
  }
  if (chosen.empty() && first.second) chosen.push_back(first.second);
  for (Task* task : chosen) task->audited = true;
  for (Task* task : chosen) produce(*task);
  drain();
  return stored;
}

void Session::count(RunResult& result) {
  const std::lock_guard guard(mutex_);
  result.tasks = counts_;
  result.failures = failures_;
  result.cancelled = stopped_ && failures_.empty();
  result.seconds = now();
}

void Session::finish_run(RunResult& result) {
  count(result);
  const std::lock_guard guard(mutex_);
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
