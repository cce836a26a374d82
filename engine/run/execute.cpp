// SPDX-License-Identifier: Apache-2.0
// Workers, values in memory, and the call of a node.
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "engine/base/element_id.h"
#include "engine/base/problem.h"
#include "engine/run/session.h"

namespace engine::run {
namespace fs = std::filesystem;
using namespace std::chrono_literals;
namespace {

// Thrown through a streaming node when nobody wants the rest of its sequence.
struct PassDone {};
// Thrown through a node when the run ends.
struct Stopped {};

}  // namespace

// --- reading --------------------------------------------------------------------------------------------------------------

// A sequence as a running task reads it. Its ids no longer change.
class TreeAccess final : public SequenceAccess {
 public:
  TreeAccess(Session& session, Tree* tree, const TypeInfo& type) : session_(session), tree_(tree), type_(type) {}
  std::size_t size() const override { return tree_->sequence->children.size(); }
  std::string id(std::size_t index) const override { return tree_->sequence->ids.at(index); }
  std::shared_ptr<const void> load(std::size_t index) const override {
    return session_.fetch(tree_->sequence->children.at(index), type_).data();
  }
  std::shared_ptr<const SequenceAccess> inner(std::size_t index) const override {
    return std::make_shared<TreeAccess>(session_, follow(tree_->sequence->children.at(index)), type_);
  }

 private:
  Session& session_;
  Tree* tree_;
  const TypeInfo& type_;
};

class TaskCall final : public Call, public Progress {
 public:
  TaskCall(Session& session, Task& task, const NodeDeclaration& declaration)
      : session_(session), task_(task), declaration_(declaration), params_(session.params_of(task)) {
    records_.resize(task.outputs.size());
    results_.resize(task.outputs.size());
    for (std::size_t o = 0; o < records_.size(); ++o) records_[o].sequence = declaration.info.outputs[o].depth > 0;
  }
  ~TaskCall() override {
    std::error_code ignored;
    if (!scratch_.empty()) fs::remove_all(scratch_, ignored);
  }

  std::shared_ptr<const void> value(std::size_t input) override {
    Tree* tree = bound(input);
    return tree ? session_.fetch(tree, *declaration_.input_types[input]).data() : nullptr;
  }
  std::shared_ptr<const SequenceAccess> sequence(std::size_t input) override {
    Tree* tree = bound(input);
    return tree ? std::make_shared<TreeAccess>(session_, tree, *declaration_.input_types[input]) : nullptr;
  }
  WindowValues window(std::size_t input) override {
    const Binding& binding = task_.inputs[input].at(0);
    const auto [begin, end] = span_of(binding, declaration_.info.inputs[input]);
    WindowValues values;
    values.centre = binding.index - begin;
    for (std::size_t i = begin; i < end; ++i)
      values.values.push_back(session_.fetch(binding.tree->sequence->children[i], *declaration_.input_types[input]).data());
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
    session_.accept_element(task_, output, std::move(id), Value(*declaration_.output_types[output], std::move(value)),
                            records_[output]);
  }
  Progress& progress() override { return *this; }

  void report(double fraction) override {
    const std::lock_guard guard(session_.mutex_);
    task_.progress = std::clamp(fraction, 0.0, 1.0);
    session_.emit(RunEvent::Kind::progress, task_);
  }
  bool stop_requested() const override { return session_.stopped_; }
  void warn(const std::string& text) override {
    const std::lock_guard guard(session_.mutex_);
    task_.warnings.push_back(text);
    session_.emit(RunEvent::Kind::warning, task_, text);
  }
  std::string scratch_folder() override {
    if (scratch_.empty()) {
      scratch_ = session_.store_.folder() + "/scratch/" + task_.key.hex() + "-" + std::to_string(::getpid());
      fs::create_directories(scratch_);
    }
    return scratch_;
  }

  std::vector<OutputRecord> records_;
  std::vector<Value> results_;

 private:
  Tree* bound(std::size_t input) const {
    return task_.inputs[input].empty() ? nullptr : task_.inputs[input][0].tree;
  }
  Session& session_;
  Task& task_;
  const NodeDeclaration& declaration_;
  const std::vector<ParamValue>& params_;
  std::string scratch_;
};

Value Session::fetch(Tree* leaf, const TypeInfo& type) {
  std::unique_lock guard(mutex_);
  leaf = follow(leaf);
  if (leaf->value) return leaf->value;
  if (!leaf->cheap) {
    guard.unlock();
    if (auto value = load_value(type, leaf->identity, store_)) {
      guard.lock();
      if (leaf->uses > 1) hold_value(leaf, *value);  // another task reads it too
      make_room(false);
      return *value;
    }
    guard.lock();
    if (leaf->value) return leaf->value;
  }
  ++leaf->pins;
  produce(*leaf->producer);
  wait_blocked(guard, [&] { return static_cast<bool>(leaf->value) || leaf->producer->state == Task::State::failed; });
  --leaf->pins;
  if (!leaf->value) {
    if (stopped_) throw Stopped{};
    throw EngineError("a value that it reads, of " + name_of(*leaf->producer) + ", could not be made again");
  }
  const Value value = leaf->value;
  drop_unused(leaf);
  return value;
}

// Waits without holding a worker's place: another thread takes it.
void Session::wait_blocked(std::unique_lock<std::mutex>& guard, const std::function<bool()>& until) {
  if (until()) return;
  ++blocked_;
  --active_;
  if (alive_ - blocked_ < most_workers_ && !stopped_) start_worker();
  changed_.notify_all();
  while (!until() && !stopped_) changed_.wait_for(guard, 200ms);
  ++active_;
  --blocked_;
}

// --- values in memory -------------------------------------------------------------------------------------------------------

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
  if (leaf->pins > 0) changed_.notify_all();
}

void Session::drop_value(Tree* leaf) {
  if (!leaf->value || leaf->source) return;
  used_ -= static_cast<std::int64_t>(leaf->bytes);
  leaf->value = {};
  changed_.notify_all();
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
  each_input_leaf(task, [&](Tree* leaf) {
    if (available(leaf)) return;
    leaf->requests.push_back(&task);
    ++task.missing;
    produce(*leaf->producer);
  });
  if (--task.missing == 0) enqueue(task);
}

// The task shall make its values (again).
void Session::produce(Task& task) {
  if (task.state != Task::State::known) return;
  task.state = Task::State::wanted;
  task.repeated = true;
  launch(task);
}

// --- scheduling -----------------------------------------------------------------------------------------------------------

// Depth first: what is nearest to the outputs, then what was made first.
bool Session::Later::operator()(const Task* a, const Task* b) const {
  return a->node != b->node ? a->node < b->node : a->serial > b->serial;
}

void Session::enqueue(Task& task) {
  task.state = Task::State::ready;
  ready_.push(&task);
  changed_.notify_all();
}

void Session::start_worker() {
  ++alive_;
  threads_.emplace_back([this] { worker(); });
}

void Session::join_workers() {
  std::unique_lock guard(mutex_);
  while (!threads_.empty()) {
    std::vector<std::thread> threads = std::move(threads_);
    threads_.clear();
    guard.unlock();
    for (std::thread& thread : threads) thread.join();
    guard.lock();
  }
}

void Session::worker() {
  std::unique_lock guard(mutex_);
  while (!stopped_) {
    if (ready_.empty() || active_ >= most_workers_) {
      if (idle()) break;
      changed_.wait_for(guard, 200ms);
      continue;
    }
    Task* task = ready_.top();
    ready_.pop();
    ++active_;
    ++running_;
    run_task(*task, guard);
    --running_;
    --active_;
    changed_.notify_all();
  }
  --alive_;
  changed_.notify_all();
}

void Session::work() {
  std::unique_lock guard(mutex_);
  for (int i = 0; i < most_workers_ && !idle(); ++i) start_worker();
  while (!idle() && !stopped_ && !fatal_) {
    changed_.wait_for(guard, 50ms);
    if (options_.stop_requested && options_.stop_requested()) stopped_ = true;
  }
  if (fatal_) stopped_ = true;
  changed_.notify_all();
  // A node that does not look at its stop request would hold the process: whoever asked for the stop may leave at once.
  const auto patience = std::chrono::steady_clock::now() + 700ms;
  while (running_ > 0 && stopped_) {
    if (changed_.wait_until(guard, patience) == std::cv_status::timeout && running_ > 0) {
      if (options_.abandon && !fatal_) {
        guard.unlock();
        options_.abandon();
        guard.lock();
      }
      break;
    }
  }
  guard.unlock();
  join_workers();
  if (fatal_) std::rethrow_exception(fatal_);
}

// --- one task -------------------------------------------------------------------------------------------------------------

void Session::run_task(Task& task, std::unique_lock<std::mutex>& guard) {
  task.state = Task::State::running;
  const NodeInfo& info = *node(task.node).info;
  guard.unlock();
  std::unique_ptr<Store::KeyLock> lock;
  std::string failure;
  std::vector<OutputRecord> records;
  const auto begin = std::chrono::steady_clock::now();
  bool found = false, stopped = false;
  try {
    if (!info.cheap) {
      lock = store_.try_lock(task.key);
      if (!lock) {
        // Another process computes it: look again later, after whatever else there is to do.
        std::this_thread::sleep_for(2ms);
        guard.lock();
        enqueue(task);
        return;
      }
      if (!task.repeated)
        if (auto others = store_.find_outputs(task.key)) {
          records = std::move(*others);
          found = true;
        }
    }
    if (!found) {
      {
        guard.lock();
        emit(RunEvent::Kind::started, task);
        guard.unlock();
      }
      records = call_node(task);
      check_sources(task);
      if (!task.repeated) {
        TaskRecord record;
        record.key = task.key;
        record.outputs = records;
        record.warnings = task.warnings;
        record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        guard.lock();
        record.parts = key_parts(task);
        guard.unlock();
        store_.publish(record);
      }
    }
  } catch (const PassDone&) {
    records.clear();
  } catch (const Stopped&) {
    stopped = true;
  } catch (const EngineError& error) {
    // The store or the disk: no other task will fare better.
    guard.lock();
    if (!fatal_) fatal_ = std::make_exception_ptr(EngineError(name_of(task) + " (" + info.name + "): " + error.what()));
    task.state = Task::State::failed;
    changed_.notify_all();
    return;
  } catch (const PluginError&) {
    guard.lock();
    if (!fatal_) fatal_ = std::current_exception();
    task.state = Task::State::failed;
    changed_.notify_all();
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
    } else if (!info.cheap) {
      ++counts_.run;
      emit(RunEvent::Kind::finished, task, {}, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    finish_task(task, records);
  }
  drain();
}

std::vector<OutputRecord> Session::call_node(Task& task) {
  const NodeDeclaration& declaration = plugins_.load(node(task.node).info->name);
  const bool cheap = declaration.info.cheap;
  TaskCall call(*this, task, declaration);
  // A function's own parallel loops must not pick up other work of this thread's arena.
  tbb::this_task_arena::isolate([&] { declaration.run(call); });
  for (std::size_t o = 0; o < call.records_.size(); ++o) {
    if (call.records_[o].sequence) continue;
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
                             declaration.info.outputs[o].name + "')");
    if (wanted(leaf)) hold_value(leaf, std::move(value));
    make_room(false);
  }
  return std::move(call.records_);
}

void Session::accept_element(Task& task, std::size_t output, std::string id, Value value, OutputRecord& record) {
  const std::string canonical = canonical_id(id);
  if (canonical.empty())
    throw std::logic_error("it gave an element the id '" + id + "': expected letters, digits, '_', '-' and '.', and not digits-digits");
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
  if (task.repeated && ordinal % 32 == 31 && !wanted_from(task, output, ordinal + 1)) throw PassDone{};
  throttle(guard);
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

// Back-pressure: while the budget is exceeded and something else goes on, the producer waits, and another worker takes its
// place; when nothing else goes on, values that can be made again go, and the budget is exceeded rather than never reached.
void Session::throttle(std::unique_lock<std::mutex>& guard) {
  make_room(false);
  if (used_ <= budget_) return;
  wait_blocked(guard, [&] { return used_ <= budget_ || (running_ <= blocked_ && ready_.empty()); });
  if (stopped_) throw Stopped{};
  if (used_ > budget_) make_room(true);
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
  const std::string message = name_of(task) + " (" + node(task.node).info->name + "): " + text + " [key " + task.key.brief() + "]";
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
  changed_.notify_all();
  if (options_.fail_fast) stopped_ = true;
}

// A file of the user's that changed while it was read would put a wrong result under a right key.
void Session::check_sources(const Task& task) {
  std::vector<std::string> paths;
  {
    const std::lock_guard guard(mutex_);
    for (const auto& port : task.inputs)
      for (const Binding& binding : port)
        if (binding.tree && binding.tree->source)
          for (const auto& [path, tree] : sources_)
            if (tree == binding.tree) paths = paths_of_source_[path];
  }
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
  event.text = std::move(text);
  event.seconds = seconds;
  event.fraction = task.progress;
  event.done = counts_.run + counts_.reused + counts_.failed + counts_.blocked;
  event.known = std::max(known_tasks_, event.done);
  options_.observer(event);
}

}  // namespace engine::run
