// SPDX-License-Identifier: Apache-2.0
// A task's way from being wanted to its end.
#include <algorithm>

#include "engine/base/problem.h"
#include "engine/run/session.h"

namespace engine::run {

// Asks for the values that the task will read; when all are there it is ready.
void Session::launch(Task& task) {
  task.missing = 1;  // not ready while asking
  const Task* lost = nullptr;
  each_input_leaf(task, [&](Tree* leaf) {
    if (available(leaf)) return;
    if (leaf->producer->state == Task::State::failed) lost = leaf->producer;
    leaf->requests.push_back(&task);
    ++task.missing;
    produce(*leaf->producer);
  });
  if (lost && task.state == Task::State::wanted)
    return fail_task(task, "a value that it reads, of " + name_of(*lost) + ", could not be made again");
  if (--task.missing == 0) enqueue(task);
}

// A running task stands still until this one has run (again). A producer of a sequence, such as a film's decoder, then
// goes before all others: it comes first in the graph, and so would be the last. Only such a one: it waits while the
// budget is exceeded, where single values would pile up before those who use them.
void Session::await(Task& task) {
  const auto streams = [](const Tree* output) { return output->state == Tree::State::sequence; };
  if (task.awaited || !std::any_of(task.outputs.begin(), task.outputs.end(), streams)) return;
  const bool queued = ready_.erase(&task) > 0;
  task.awaited = true;
  if (queued) ready_.insert(&task);
}

// The task shall make its values (again).
void Session::produce(Task& task) {
  if (task.state != Task::State::known) return;
  task.state = Task::State::wanted;
  task.repeated = true;
  launch(task);
}

void Session::run_task(Task& task, std::unique_lock<std::mutex>& guard) {
  task.state = Task::State::running;
  task.awaited = false;
  const NodeInfo& info = *node(task.node).info;
  guard.unlock();
  std::unique_ptr<Store::KeyLock> lock;
  std::string failure;
  std::vector<OutputRecord> records;
  const auto begin = std::chrono::steady_clock::now();
  double seconds = 0;
  bool found = false, stopped = false;
  try {
    if (!info.cheap) {
      lock = store_.try_lock(task.key);
      if (!lock) {
        guard.lock();
        return postpone(task);
      }
      if (!task.repeated)
        if (auto others = store_.find_outputs(task.key); others && others->size() == task.outputs.size()) {
          records = std::move(*others);
          found = true;
        }
    }
    if (!found) compute(task, records, begin);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  } catch (const PassDone&) {
    records.clear();
  } catch (const Stopped&) {
    stopped = true;
  } catch (const EngineError& error) {
    // The store or the disk: no other task will fare better.
    guard.lock();
    if (!fatal_) fatal_ = std::make_exception_ptr(EngineError(name_of(task) + " (" + info.name + "): " + error.what()));
    task.state = Task::State::failed;
    return;
  } catch (const PluginError&) {
    guard.lock();
    if (!fatal_) fatal_ = std::current_exception();
    task.state = Task::State::failed;
    return;
  } catch (const std::exception& error) {
    failure = error.what();
    if (failure.empty()) failure = "it failed without a message";
  } catch (...) {
    failure = "it threw something that is no std::exception";
  }
  lock.reset();
  guard.lock();
  if (stopped) {
    task.state = Task::State::known;
    return;
  }
  if (!failure.empty()) {
    fail_task(task, failure);
  } else {
    if (found) {
      ++counts_.reused;
      emit(RunEvent::Kind::reused, task);
      if (!records.empty() && records.front().warned) tell_old_warnings(task);
    } else {
      if (!info.cheap) ++counts_.run;
      if (info.cheap) note_pace(task.node, seconds);
      emit(info.cheap ? RunEvent::Kind::made : RunEvent::Kind::finished, task, {}, seconds);
    }
    finish_task(task, records);
  }
  drain();
}

// Runs the node and makes its record known to all.
void Session::compute(Task& task, std::vector<OutputRecord>& records, std::chrono::steady_clock::time_point begin) {
  {
    const std::lock_guard guard(mutex_);
    emit(RunEvent::Kind::started, task);
  }
  records = call_node(task);
  if (task.repeated) return;
  TaskRecord record;
  record.key = task.key;
  record.outputs = records;
  record.warnings = task.warnings;
  if (!record.outputs.empty()) record.outputs.front().warned = !record.warnings.empty();
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  {
    const std::lock_guard guard(mutex_);
    record.parts = key_parts(task);
  }
  store_.publish(record);
}

void Session::finish_task(Task& task, const std::vector<OutputRecord>& records) {
  if (records.empty()) {
    task.state = Task::State::known;  // a pass that nobody wanted to the end
  } else {
    install(task, records);
  }
  // Elements that were asked for after the pass had gone by them need another one.
  for (Tree* output : task.outputs) {
    const auto asked = [](const Tree* leaf) { return !leaf->value && (leaf->pins > 0 || !leaf->requests.empty()); };
    bool again = output->state == Tree::State::leaf && asked(output);
    if (output->state == Tree::State::sequence)
      again = std::any_of(output->sequence->children.begin(), output->sequence->children.end(), asked);
    if (again) return produce(task);
  }
  for (Tree* output : task.outputs)
    if (output->state == Tree::State::leaf) drop_unused(output);
}

void Session::fail_task(Task& task, const std::string& text) {
  task.state = Task::State::failed;
  ++counts_.failed;
  const std::string message =
      name_of(task) + " (" + node(task.node).info->name + "): " + text + " [key " + task.key.brief() + "]";
  failures_.push_back(message);
  emit(RunEvent::Kind::failed, task, message);
  for (Tree* output : task.outputs) {
    std::vector<Tree*> leaves;
    if (output->state == Tree::State::sequence)
      leaves = output->sequence->children;
    else
      leaves = {output};
    for (Tree* leaf : leaves) {
      std::vector<Task*> requests = std::move(leaf->requests);
      leaf->requests.clear();
      for (Task* waiting : requests)
        if (waiting->state == Task::State::wanted) {
          if (waiting->repeated)
            fail_task(*waiting, "a value that it reads, of " + name_of(task) + ", could not be made again");
          else
            block(*waiting);
        }
    }
    fail_tree(output);
  }
  release_inputs(task);
  tell_blocked();
  if (options_.fail_fast) stopped_ = true;
}

double Session::now() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

void Session::emit(RunEvent::Kind kind, const Task& task, std::string text, double seconds) {
  if (!options_.observer) return;
  RunEvent event;
  event.kind = kind;
  event.time_s = now();
  event.node = node(task.node).id;
  event.type = node(task.node).info->name;
  event.element = task.element;
  event.worker = task.worker;
  event.text = std::move(text);
  event.seconds = seconds;
  event.fraction = task.progress;
  event.done = counts_.run + counts_.reused + counts_.failed + counts_.blocked;
  event.known = std::max(known_tasks_, event.done);
  options_.observer(event);
}

}  // namespace engine::run
