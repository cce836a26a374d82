// SPDX-License-Identifier: Apache-2.0
// A graph becomes levels of mapping, rearrangements and tasks.
#include <algorithm>

#include "engine/run/session.h"

namespace engine::run {

// The elements asked for bound what must be made upstream, as far as nodes are fed element by element.
void Session::restrict_to_elements() {
  filtered_.assign(graph_.nodes.size(), false);
  const int target = graph_.find_node(options_.to);
  if (filter_.empty() || target < 0) return;
  std::vector<bool> whole(graph_.nodes.size(), false);
  filtered_[static_cast<std::size_t>(target)] = node(target).mapped_depth > 0 && !node(target).info->prior;
  for (std::size_t n = graph_.nodes.size(); n-- > 0;) {
    const GraphNode& consumer = graph_.nodes[n];
    if (!consumer.needed) continue;
    if (static_cast<int>(n) != target && whole[n]) filtered_[n] = false;
    for (std::size_t p = 0; p < consumer.inputs.size(); ++p) {
      const InputInfo& port = consumer.info->inputs[p];
      for (const Source& source : consumer.inputs[p]) {
        if (source.kind != Source::Kind::node) continue;
        const auto producer = static_cast<std::size_t>(source.node);
        const bool elementwise = filtered_[n] && !consumer.info->prior && !port.window && port.depth == 0 &&
                                 source.element.empty() && consumer.info->structural == Structural::none &&
                                 graph_.nodes[producer].mapped_depth == consumer.mapped_depth;
        if (!elementwise)
          whole[producer] = true;
        else if (graph_.nodes[producer].info->structural == Structural::none)
          filtered_[producer] = !graph_.nodes[producer].info->prior;
      }
    }
  }
}

void Session::expand() {
  const std::lock_guard guard(mutex_);
  restrict_to_elements();
  outputs_.resize(graph_.nodes.size());
  for (std::size_t n = 0; n < graph_.nodes.size(); ++n) {
    const GraphNode& graph_node = graph_.nodes[n];
    if (!graph_node.needed) continue;
    Bindings inputs(graph_node.inputs.size());
    for (std::size_t p = 0; p < inputs.size(); ++p)
      for (const Source& source : graph_node.inputs[p]) {
        if (source.kind == Source::Kind::none) continue;
        Binding binding;
        binding.tree = output_tree(source);
        binding.excess = graph_node.input_depth[p] - graph_node.info->inputs[p].depth;
        inputs[p].push_back(binding);
        if (graph_node.info->structural == Structural::first) break;
      }
    if (graph_node.info->structural == Structural::first) {
      outputs_[n] = {inputs[0].at(0).tree};
      continue;
    }
    for (std::size_t o = 0; o < graph_node.info->outputs.size(); ++o)
      outputs_[n].push_back(graph_node.output_depth[o] > 0 ? new_sequence() : new_tree());
    instantiate(static_cast<int>(n), std::move(inputs), "", outputs_[n], nullptr, nullptr, false);
  }
  for (const GraphOutput& output : graph_.outputs) output_roots_.push_back(output_tree(output.source));
  drain();
}

void Session::instantiate(int node_index, Bindings inputs, const std::string& path, const std::vector<Tree*>& outputs,
                          Task** made, Task* prior, bool has_prior) {
  const bool mapped = std::any_of(inputs.begin(), inputs.end(), [](const auto& port) {
    return std::any_of(port.begin(), port.end(), [](const Binding& b) { return b.tree && b.excess > 0; });
  });
  if (mapped) {
    watchers_.push_back(std::make_unique<Level>(*this, node_index, std::move(inputs), path, outputs));
    static_cast<Level&>(*watchers_.back()).start();
    return;
  }
  if (node(node_index).info->structural != Structural::none) {
    watchers_.push_back(std::make_unique<Rearrangement>(*this, node_index, std::move(inputs), outputs));
    static_cast<Rearrangement&>(*watchers_.back()).start();
    return;
  }
  Task* task = make_task(node_index, std::move(inputs), path, outputs, has_prior ? prior : nullptr);
  if (made) *made = task;
}

Task* Session::make_task(int node_index, Bindings inputs, const std::string& path, const std::vector<Tree*>& outputs,
                         Task* prior) {
  Task& task = tasks_.emplace_back();
  task.session = this;
  task.node = node_index;
  task.serial = static_cast<std::uint32_t>(tasks_.size());
  task.element = path;
  task.inputs = std::move(inputs);
  task.prior = prior;
  task.outputs = outputs;
  const GraphNode& graph_node = node(node_index);
  for (std::size_t o = 0; o < outputs.size(); ++o) {
    outputs[o]->producer = &task;
    outputs[o]->output = static_cast<std::uint32_t>(o);
    outputs[o]->cheap = graph_node.info->cheap;
  }
  for (const Override& override_ : graph_node.overrides) {
    const std::vector<std::string> ids = split_path(path);
    for (const Override::Range& range : override_.ranges) {
      bool fits = range.parents.empty() || range.parents.size() + 1 == ids.size();
      for (std::size_t i = 0; fits && i < range.parents.size(); ++i) fits = ids[i] == range.parents[i];
      if (!fits || !in_range(ids.back(), range.first, range.last)) continue;
      if (task.params.empty()) task.params = graph_node.params;
      for (const auto& [index, value] : override_.params) task.params[static_cast<std::size_t>(index)] = value;
    }
  }
  if (!graph_node.info->cheap) ++known_tasks_;

  const auto wait_for = [&](Tree* tree) {
    if (watch_settling(tree, &task)) ++task.waits;
  };
  for (std::size_t p = 0; p < task.inputs.size(); ++p)
    for (Binding& binding : task.inputs[p]) {
      if (!binding.tree) continue;
      binding.tree = follow(binding.tree);
      const InputInfo& port = graph_node.info->inputs[p];
      if (binding.windowed) {
        Tree::Sequence& around = *binding.tree->sequence;
        const auto [begin, end] = span_of(binding, port);
        for (std::size_t i = begin; i < end; ++i) {
          ++follow(around.children[i])->uses;
          wait_for(around.children[i]);
        }
        continue;
      }
      if (port.depth > 0 && binding.tree->state == Tree::State::sequence)
        ++binding.tree->sequence->gathers;
      else
        ++binding.tree->uses;
      wait_for(binding.tree);
    }
  if (prior)
    for (Tree* output : prior->outputs) {
      ++output->uses;
      wait_for(output);
    }
  if (task.waits == 0) settled_inputs(task);
  return &task;
}

void Task::update(Tree*) {
  if (--waits == 0) session->settled_inputs(*this);
}

}  // namespace engine::run
