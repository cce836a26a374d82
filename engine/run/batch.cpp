// SPDX-License-Identifier: Apache-2.0
// Cheap tasks that take microseconds run many at a time: the lock, the node's code and the arena are asked for once.
// A batch holds only tasks whose inputs are in memory and that neither stream nor wait: nothing in it can wait for
// anything behind it.
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>

#include "engine/base/problem.h"
#include "engine/run/session.h"
#include "engine/run/task_progress.h"

namespace engine::run {
namespace {

constexpr double quick_s = 25e-6;  // a task that takes less is small
constexpr double most_s = 1e-3;    // a batch that takes longer ends
constexpr std::size_t most_tasks = 64;
constexpr std::size_t most_bytes = 1 << 20;  // of inputs that it alone keeps, and of results

class BatchCall final : public Call {
 public:
  BatchCall(Session& session, const NodeDeclaration& declaration, Task& first)
      : declaration_(declaration), progress_(session, first, &cut_short_) {}

  void turn_to(Task& task, const std::vector<ParamValue>& params, const std::shared_ptr<const void>* inputs,
               Value* results) {
    progress_.turn_to(task);
    params_ = &params;
    inputs_ = inputs;
    results_ = results;
  }
  bool cut_short() const { return cut_short_; }

  std::shared_ptr<const void> value(std::size_t input) override { return inputs_[input]; }
  const ParamValue& param(std::size_t index) override { return (*params_)[index]; }
  void result(std::size_t output, std::shared_ptr<const void> value) override {
    results_[output] = Value(*declaration_.output_types[output], std::move(value));
  }
  Progress& progress() override { return progress_; }

  // A node with any of these ports is in no batch.
  std::shared_ptr<const SequenceAccess> sequence(std::size_t) override { throw std::logic_error("no sequence here"); }
  WindowValues window(std::size_t) override { throw std::logic_error("no window here"); }
  std::vector<std::shared_ptr<const void>> prior() override { return {}; }
  void push(std::size_t, std::string, std::shared_ptr<const void>) override { throw std::logic_error("no sequence"); }

 private:
  const NodeDeclaration& declaration_;
  std::atomic<bool> cut_short_ = false;
  TaskProgress progress_;
  const std::vector<ParamValue>* params_ = nullptr;
  const std::shared_ptr<const void>* inputs_ = nullptr;
  Value* results_ = nullptr;
};

}  // namespace

bool Session::is_light(int node_index) const {
  const Pace& pace = paces_[static_cast<std::size_t>(node_index)];
  return pace.simple && std::popcount(pace.quick) >= 6;
}

void Session::note_pace(int node_index, double seconds_per_task) {
  Pace& pace = paces_[static_cast<std::size_t>(node_index)];
  pace.quick = static_cast<std::uint8_t>(pace.quick << 1 | (seconds_per_task < quick_s ? 1 : 0));
}

bool Session::suits_batch(const Task& task) const {
  if (!is_light(task.node) || !task.repeated || task.audited) return false;
  return std::all_of(task.inputs.begin(), task.inputs.end(), [](const auto& port) {
    return port.empty() || !port[0].tree || (port[0].tree->value && !port[0].tree->source);
  });
}

void Session::run_batch(std::unique_lock<std::mutex>& guard) {
  const int node_index = next_ready().node;
  const NodeInfo& info = *node(node_index).info;
  const std::size_t inputs = info.inputs.size(), outputs = info.outputs.size();
  std::vector<Task*> tasks;
  std::vector<std::shared_ptr<const void>> values;
  tasks.reserve(most_tasks);
  values.reserve(most_tasks * inputs);
  std::size_t bytes = 0;
  while (!ready_.empty() && tasks.size() < most_tasks && bytes < most_bytes) {
    Task* task = &next_ready();
    if (task->node != node_index || !suits_batch(*task)) break;
    ready_.erase(ready_.begin());
    task->state = Task::State::running;
    task->awaited = false;
    task->worker = current_worker();
    emit(RunEvent::Kind::started, *task);
    for (const auto& port : task->inputs) {
      const Tree* leaf = port.empty() ? nullptr : port[0].tree;
      values.push_back(leaf ? leaf->value.data() : nullptr);
      if (leaf && leaf->uses <= 1) bytes += leaf->bytes;
    }
    tasks.push_back(task);
  }
  wake_worker();
  guard.unlock();

  using clock = std::chrono::steady_clock;
  const NodeDeclaration& declaration = plugins_.load(info.name);
  std::vector<Value> results(tasks.size() * outputs);
  std::vector<std::string> failures(tasks.size());
  std::vector<double> seconds(tasks.size());
  std::size_t done = 0;
  bool stopped = false;
  const auto begin = clock::now();
  auto from = begin;
  bytes = 0;
  tbb::this_task_arena::isolate([&] {
    BatchCall call(*this, declaration, *tasks[0]);
    while (done < tasks.size() && !stopped) {
      Value* made = results.data() + done * outputs;
      call.turn_to(*tasks[done], params_of(*tasks[done]), values.data() + done * inputs, made);
      try {
        declaration.run(call);
        for (std::size_t o = 0; o < outputs; ++o) {
          if (!made[o]) throw std::logic_error("it gave no value for its output '" + info.outputs[o].name + "'");
          bytes += made[o].size_bytes();
        }
      } catch (const EngineError&) {
        throw;
      } catch (const std::exception& error) {
        failures[done] = error.what();
        if (failures[done].empty()) failures[done] = "it failed without a message";
      } catch (...) {
        failures[done] = "it threw something that is no std::exception";
      }
      stopped = call.cut_short();
      const auto now = clock::now();
      seconds[done] = std::chrono::duration<double>(now - from).count();
      from = now;
      ++done;
      if (bytes >= most_bytes || std::chrono::duration<double>(now - begin).count() >= most_s) break;
    }
  });
  values.clear();

  guard.lock();
  note_pace(node_index, std::chrono::duration<double>(from - begin).count() / static_cast<double>(done));
  for (std::size_t t = done; t < tasks.size(); ++t) enqueue(*tasks[t]);
  for (std::size_t t = 0; t < done; ++t) {
    Task& task = *tasks[t];
    if (stopped && t + 1 == done) {
      task.state = Task::State::known;
      continue;
    }
    if (!failures[t].empty()) {
      fail_task(task, failures[t]);
      continue;
    }
    for (std::size_t o = 0; o < outputs; ++o)
      if (wanted(task.outputs[o])) hold_value(task.outputs[o], std::move(results[t * outputs + o]));
    make_room(false);
    emit(RunEvent::Kind::made, task, {}, seconds[t]);
    finish_task(task, std::vector<OutputRecord>());
  }
  drain();
}

}  // namespace engine::run
