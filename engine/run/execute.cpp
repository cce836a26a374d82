// SPDX-License-Identifier: Apache-2.0
// Values in memory, and the call of a node.
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>

#include "engine/base/element_id.h"
#include "engine/base/problem.h"
#include "engine/run/session.h"
#include "engine/run/task_progress.h"

namespace engine::run {

// --- reading
// --------------------------------------------------------------------------------------------------------------

// A sequence as a running task reads it. Its ids no longer change.
class TreeAccess final : public SequenceAccess {
 public:
  TreeAccess(Session& session, Tree* tree, const TypeInfo& type, std::shared_ptr<std::atomic<bool>> cut_short)
      : session_(session), tree_(tree), type_(type), cut_short_(std::move(cut_short)) {}
  std::size_t size() const override { return tree_->sequence->children.size(); }
  std::string id(std::size_t index) const override { return tree_->sequence->ids.at(index); }
  std::shared_ptr<const void> load(std::size_t index) const override {
    try {
      return session_.fetch(tree_->sequence->children.at(index), type_, tree_, index).data();
    } catch (const Stopped&) {
      *cut_short_ = true;
      throw;
    }
  }
  std::shared_ptr<const SequenceAccess> inner(std::size_t index) const override {
    return std::make_shared<TreeAccess>(session_, follow(tree_->sequence->children.at(index)), type_, cut_short_);
  }

 private:
  Session& session_;
  Tree* tree_;
  const TypeInfo& type_;
  std::shared_ptr<std::atomic<bool>> cut_short_;
};

class TaskCall final : public Call {
 public:
  TaskCall(Session& session, Task& task, const NodeDeclaration& declaration)
      : session_(session),
        task_(task),
        declaration_(declaration),
        params_(session.params_of(task)),
        files_(session.source_paths(task)),
        progress_(session, task, cut_short_.get()) {
    records_.resize(task.outputs.size());
    results_.resize(task.outputs.size());
    for (std::size_t o = 0; o < records_.size(); ++o) records_[o].sequence = declaration.info.outputs[o].depth > 0;
  }

  std::shared_ptr<const void> value(std::size_t input) override {
    Tree* tree = bound(input);
    return tree ? session_.fetch(tree, *declaration_.input_types[input]).data() : nullptr;
  }
  std::shared_ptr<const SequenceAccess> sequence(std::size_t input) override {
    Tree* tree = bound(input);
    return tree ? std::make_shared<TreeAccess>(session_, tree, *declaration_.input_types[input], cut_short_) : nullptr;
  }
  WindowValues window(std::size_t input) override {
    const Binding& binding = task_.inputs[input].at(0);
    WindowValues values;
    std::vector<Tree*> around;
    {
      // The sequence may still be growing.
      const std::lock_guard guard(session_.mutex_);
      const auto [begin, end] = span_of(binding, declaration_.info.inputs[input]);
      values.centre = binding.index - begin;
      const std::vector<Tree*>& children = binding.tree->sequence->children;
      around.assign(children.begin() + static_cast<std::ptrdiff_t>(begin),
                    children.begin() + static_cast<std::ptrdiff_t>(end));
    }
    for (Tree* tree : around) values.values.push_back(session_.fetch(tree, *declaration_.input_types[input]).data());
    return values;
  }
  std::vector<std::shared_ptr<const void>> prior() override {
    std::vector<std::shared_ptr<const void>> values;
    if (task_.prior)
      for (std::size_t o = 0; o < task_.prior->outputs.size(); ++o)
        values.push_back(session_.fetch(task_.prior->outputs[o], *declaration_.output_types[o]).data());
    return values;
  }
  const ParamValue& param(std::size_t index) override { return params_[index]; }
  void result(std::size_t output, std::shared_ptr<const void> value) override {
    results_[output] = Value(*declaration_.output_types[output], std::move(value));
  }
  void push(std::size_t output, std::string id, std::shared_ptr<const void> value) override {
    progress_.check_timeout(false);
    // What is handed on was read from files that had not changed. (Of many files: looked at when all is done.)
    if (files_.size() <= most_files_per_push) session_.check_sources(files_);
    try {
      session_.accept_element(task_, output, std::move(id), Value(*declaration_.output_types[output], std::move(value)),
                              records_[output]);
    } catch (const Stopped&) {
      *cut_short_ = true;
      throw;
    }
  }
  Progress& progress() override { return progress_; }

  std::vector<OutputRecord> records_;
  std::vector<Value> results_;
  // The node was told of the run's end: what it returns may be half a result.
  bool cut_short() const { return *cut_short_; }
  const std::vector<std::string>& files() const { return files_; }
  void check_timeout() const { progress_.check_timeout(true); }

 private:
  static constexpr std::size_t most_files_per_push = 16;
  Tree* bound(std::size_t input) const { return task_.inputs[input].empty() ? nullptr : task_.inputs[input][0].tree; }
  Session& session_;
  Task& task_;
  const NodeDeclaration& declaration_;
  const std::vector<ParamValue>& params_;
  const std::vector<std::string> files_;  // the user's, which the task reads
  const std::shared_ptr<std::atomic<bool>> cut_short_ = std::make_shared<std::atomic<bool>>(false);
  TaskProgress progress_;
};

Value Session::fetch(Tree* leaf, const TypeInfo& type, const Tree* sequence, std::size_t index) {
  std::unique_lock guard(mutex_);
  leaf = follow(leaf);
  if (leaf->value) return leaf->value;
  if (!leaf->cheap) {
    guard.unlock();
    if (auto value = load_value(type, leaf->identity, store_)) {
      guard.lock();
      if (leaf->uses > 1) {  // another task reads it too
        hold_value(leaf, *value);
        wake_worker();
      }
      make_room(false);
      return *value;
    }
    guard.lock();
    if (leaf->value) return leaf->value;
  }
  ++leaf->pins;
  produce(*leaf->producer);
  if (sequence) read_ahead(*sequence, index);
  drain();
  const auto there = [&] { return static_cast<bool>(leaf->value) || leaf->producer->state == Task::State::failed; };
  // Small tasks are done before another thread has woken; none of them waits for anything.
  while (!there() && !stopped_ && !ready_.empty() && suits_batch(*ready_.top())) run_batch(guard);
  wait_blocked(guard, there);
  --leaf->pins;
  if (!leaf->value) {
    if (stopped_) throw Stopped{};
    throw std::runtime_error("a value that it reads, of " + name_of(*leaf->producer) + ", could not be made again");
  }
  const Value value = leaf->value;
  drop_unused(leaf);
  return value;
}

// Who reads an element of a cheap sequence will read the next ones.
void Session::read_ahead(const Tree& sequence, std::size_t index) {
  constexpr std::size_t small_tasks = 64;
  const std::vector<Tree*>& children = sequence.sequence->children;
  const Tree* first = follow(children[index]);
  const std::size_t ahead = is_light(first->producer->node) ? small_tasks : static_cast<std::size_t>(most_workers_ - 1);
  for (std::size_t i = index + 1; i < std::min(children.size(), index + ahead) && used_ < budget_ / 2; ++i) {
    const Tree* next = follow(children[i]);
    if (next->state == Tree::State::leaf && next->cheap && !next->value &&
        next->producer->node == first->producer->node)
      produce(*next->producer);
  }
}

// --- values in memory
// -------------------------------------------------------------------------------------------------------

void Session::hold_value(Tree* leaf, Value value) {
  if (!leaf->value) {
    leaf->bytes = value.size_bytes();
    leaf->value = std::move(value);
    used_ += static_cast<std::int64_t>(leaf->bytes);
    resident_.push_back(leaf);
  }
  std::vector<Task*> requests = std::move(leaf->requests);
  leaf->requests.clear();
  for (Task* task : requests)
    if (--task->missing == 0 && task->state == Task::State::wanted) enqueue(*task);
  if (leaf->pins > 0) tell_blocked();
}

void Session::drop_value(Tree* leaf) {
  if (!leaf->value || leaf->source) return;
  used_ -= static_cast<std::int64_t>(leaf->bytes);
  leaf->value = {};
  tell_blocked();
}

// Evicts until the budget holds: what the store has, and what only a gather will read one day; cheap values that a task
// waits for go only when nothing else goes on.
void Session::make_room(bool cheap_too) {
  if (used_ <= budget_) return;
  std::deque<Tree*> kept;
  while (used_ > budget_ && !resident_.empty()) {
    Tree* leaf = resident_.front();
    resident_.pop_front();
    if (!leaf->value) continue;
    const bool awaited = leaf->uses > 0 || !leaf->requests.empty();
    if (leaf->pins > 0 || (leaf->cheap && awaited && !cheap_too)) {
      kept.push_back(leaf);
      continue;
    }
    drop_value(leaf);
  }
  while (!kept.empty()) {
    resident_.push_front(kept.back());
    kept.pop_back();
  }
}

bool Session::available(Tree* leaf) {
  return leaf->source || leaf->value || (!leaf->cheap && leaf->has_identity && store_.has(leaf->identity));
}

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

// The task shall make its values (again).
void Session::produce(Task& task) {
  if (task.state != Task::State::known) return;
  task.state = Task::State::wanted;
  task.repeated = true;
  launch(task);
}

// --- one task
// -------------------------------------------------------------------------------------------------------------

void Session::run_task(Task& task, std::unique_lock<std::mutex>& guard) {
  task.state = Task::State::running;
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

std::vector<OutputRecord> Session::call_node(Task& task) {
  const NodeDeclaration& declaration = plugins_.load(node(task.node).info->name);
  const bool cheap = declaration.info.cheap;
  TaskCall call(*this, task, declaration);
  // A function's own parallel loops must not pick up other work of this thread's arena.
  tbb::this_task_arena::isolate([&] { declaration.run(call); });
  if (call.cut_short()) throw Stopped{};
  call.check_timeout();
  check_sources(call.files());
  for (std::size_t o = 0; o < call.records_.size(); ++o) {
    if (call.records_[o].sequence) {
      if (task.repeated) compare_length(task, o, call.records_[o]);
      continue;
    }
    Value value = call.results_[o];
    if (!value) throw std::logic_error("it gave no value for its output '" + declaration.info.outputs[o].name + "'");
    OutputRecord::Element element;
    if (!cheap) {
      const Bytes bytes = encode_value(value, store_);
      element.identity = digest_of(bytes);
      store_.put(element.identity, bytes);
      if (value.type().name == "file")
        if (auto stored = load_value(value.type(), element.identity, store_)) value = *stored;
    }
    call.records_[o].elements.push_back(element);
    const std::lock_guard guard(mutex_);
    Tree* leaf = task.outputs[o];
    if (task.repeated && !cheap && leaf->identity != element.identity)
      throw std::logic_error("run again, it gave another result than before: it is not deterministic (output '" +
                             declaration.info.outputs[o].name + "': " + leaf->identity.brief() + " before, " +
                             element.identity.brief() + " now)");
    if (wanted(leaf)) hold_value(leaf, std::move(value));
    make_room(false);
  }
  return std::move(call.records_);
}

void Session::accept_element(Task& task, std::size_t output, std::string id, Value value, OutputRecord& record) {
  const std::string canonical = canonical_id(id);
  if (canonical.empty())
    throw std::logic_error("it gave an element the id '" + id +
                           "': expected letters, digits, '_', '-' and '.', and not digits-digits");
  const std::size_t ordinal = record.elements.size();
  const bool cheap = node(task.node).info->cheap;
  OutputRecord::Element element{canonical, {}};
  if (cheap) {
    Bytes bytes;
    ByteWriter writer(bytes);
    writer.raw(task.key.bytes.data(), task.key.bytes.size());
    writer.count(output);
    writer.count(ordinal);
    element.identity = digest_of(bytes);
  } else {
    const Bytes bytes = encode_value(value, store_);
    element.identity = digest_of(bytes);
    store_.put(element.identity, bytes);
    if (value.type().name == "file")
      if (auto stored = load_value(value.type(), element.identity, store_)) value = *stored;
  }
  record.elements.push_back(element);

  std::unique_lock guard(mutex_);
  if (stopped_) throw Stopped{};
  Tree* sequence = task.outputs[output];
  Tree* leaf = nullptr;
  if (ordinal < sequence->sequence->children.size()) {
    leaf = sequence->sequence->children[ordinal];
    if (sequence->sequence->ids[ordinal] != canonical || (!cheap && leaf->identity != element.identity))
      throw std::logic_error("run again, it gave another element at position " + std::to_string(ordinal) +
                             " than before: it is not deterministic");
    if (wanted(leaf)) hold_value(leaf, std::move(value));
  } else {
    if (sequence->sequence->complete)
      throw std::logic_error("run again, it gave more elements than before: it is not deterministic");
    if (!sequence->sequence->positions.emplace(canonical, ordinal).second)
      throw std::logic_error("it gave two elements the id '" + canonical + "'");
    leaf = new_tree();
    leaf->state = Tree::State::leaf;
    leaf->settled = true;
    leaf->producer = &task;
    leaf->output = static_cast<std::uint32_t>(output);
    leaf->ordinal = static_cast<std::uint32_t>(ordinal);
    leaf->cheap = cheap;
    leaf->identity = element.identity;
    leaf->has_identity = true;
    leaf->pins = 1;  // until its readers are known
    hold_value(leaf, std::move(value));
    add_child(sequence, canonical, leaf);
    drain();
    leaf->pins = 0;
    drop_unused(leaf);
  }
  wake_worker();
  if (task.repeated && !task.audited && ordinal % 32 == 31 && !wanted_from(task, output, ordinal + 1)) throw PassDone{};
  throttle(guard);
}

// A pass that ended of itself has given as many elements as the first one.
void Session::compare_length(const Task& task, std::size_t output, const OutputRecord& record) {
  const std::lock_guard guard(mutex_);
  const std::size_t before = task.outputs[output]->sequence->children.size();
  if (record.elements.size() < before)
    throw std::logic_error("run again, it gave " + std::to_string(record.elements.size()) + " elements, before " +
                           std::to_string(before) + ": it is not deterministic");
}

bool Session::wanted_from(const Task& task, std::size_t output, std::size_t from) const {
  for (std::size_t o = 0; o < task.outputs.size(); ++o) {
    const Tree* tree = task.outputs[o];
    if (tree->state != Tree::State::sequence) {
      if (wanted(tree)) return true;
      continue;
    }
    if (o != output) return true;
    if (tree->sequence->gathers > 0) return true;
    for (std::size_t i = from; i < tree->sequence->children.size(); ++i)
      if (wanted(tree->sequence->children[i])) return true;
  }
  return false;
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

// The user's files that a task reads: directly, in a window, or as a whole sequence of them.
std::vector<std::string> Session::source_paths(const Task& task) {
  const std::lock_guard guard(mutex_);
  std::vector<std::string> paths;
  const auto add = [&](auto& self, Tree* tree) -> void {
    tree = follow(tree);
    if (const auto known = opened_.find(tree); known != opened_.end())
      paths.insert(paths.end(), known->second.files.begin(), known->second.files.end());
    else if (tree->state == Tree::State::sequence)
      for (Tree* child : tree->sequence->children) self(self, child);
  };
  for (std::size_t p = 0; p < task.inputs.size(); ++p)
    for (const Binding& binding : task.inputs[p]) {
      if (!binding.tree || node(task.node).info->inputs[p].type != "file") continue;
      if (!binding.windowed) {
        add(add, binding.tree);
        continue;
      }
      const auto [begin, end] = span_of(binding, node(task.node).info->inputs[p]);
      for (std::size_t i = begin; i < end; ++i) add(add, binding.tree->sequence->children[i]);
    }
  return paths;
}

// A file of the user's that changed while it was read would put a wrong result under a right key.
void Session::check_sources(const std::vector<std::string>& paths) const {
  for (const std::string& path : paths)
    if (!store_.unchanged_since_digest(path))
      throw std::runtime_error("file " + path + " changed while it was read: run again");
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
