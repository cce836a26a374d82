// SPDX-License-Identifier: Apache-2.0
// The call of a node: what it reads and what it gives.
#include <tbb/task_arena.h>

#include <algorithm>

#include "engine/base/element_id.h"
#include "engine/run/session.h"
#include "engine/run/task_progress.h"

namespace engine::run {

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

}  // namespace engine::run
