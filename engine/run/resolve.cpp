// SPDX-License-Identifier: Apache-2.0
// A task whose inputs are known: its key, and what the store has under it.
#include <algorithm>

#include "engine/run/session.h"

namespace engine::run {
namespace {

// Bumped when the way keys are made changes: old records are then found no more.
constexpr std::string_view key_format = "facegraph key 1";

void write_digest(ByteWriter& writer, const Digest& digest) { writer.raw(digest.bytes.data(), digest.bytes.size()); }

}  // namespace

// The identity of a sequence is that of its ordered ids and elements.
const Digest& Session::identity_of(Tree* tree) {
  if (tree->has_identity) return tree->identity;
  Bytes bytes;
  ByteWriter writer(bytes);
  writer.text("sequence");
  const Tree::Sequence& held = *tree->sequence;
  writer.count(held.children.size());
  for (std::size_t i = 0; i < held.children.size(); ++i) {
    writer.text(held.ids[i]);
    write_digest(writer, identity_of(follow(held.children[i])));
  }
  tree->identity = digest_of(bytes);
  tree->has_identity = true;
  return tree->identity;
}

const std::vector<ParamValue>& Session::params_of(const Task& task) const {
  return task.params.empty() ? node(task.node).params : task.params;
}

// Node, version, plugin and parameters.
const Digest& Session::prefix_of(int node_index, const std::vector<ParamValue>* overridden) {
  const auto make = [&](const std::vector<ParamValue>& params) {
    const NodeInfo& info = *node(node_index).info;
    Bytes bytes;
    ByteWriter writer(bytes);
    writer.text(key_format);
    writer.text(info.name);
    writer.number(static_cast<std::int32_t>(info.version));
    write_digest(writer, plugins_.digest(info.name));
    for (const ParamValue& value : params) writer.text(to_text(value));
    return digest_of(bytes);
  };
  if (overridden) {
    static thread_local Digest made;
    made = make(*overridden);
    return made;
  }
  const auto known = prefixes_.find(node_index);
  if (known != prefixes_.end()) return known->second;
  return prefixes_[node_index] = make(node(node_index).params);
}

Digest Session::key_of(Task& task) {
  thread_local Bytes bytes;
  bytes.clear();
  ByteWriter writer(bytes);
  write_digest(writer, prefix_of(task.node, task.params.empty() ? nullptr : &task.params));
  const NodeInfo& info = *node(task.node).info;
  for (std::size_t p = 0; p < task.inputs.size(); ++p) {
    if (task.inputs[p].empty() || !task.inputs[p][0].tree) {
      writer.number(std::uint8_t{0});
      continue;
    }
    const Binding& binding = task.inputs[p][0];
    if (!binding.windowed) {
      writer.number(std::uint8_t{1});
      write_digest(writer, identity_of(binding.tree));
      continue;
    }
    const Tree::Sequence& around = *binding.tree->sequence;
    const auto [begin, end] = span_of(binding, info.inputs[p]);
    writer.number(std::uint8_t{2});
    writer.count(end - begin);
    writer.count(binding.index - begin);
    for (std::size_t i = begin; i < end; ++i) write_digest(writer, identity_of(follow(around.children[i])));
  }
  if (info.prior) {
    writer.number(static_cast<std::uint8_t>(task.prior ? 1 : 0));
    if (task.prior)
      for (Tree* output : task.prior->outputs) write_digest(writer, identity_of(output));
  }
  return digest_of(bytes);
}

void Session::drain() {
  if (draining_) return;
  draining_ = true;
  while (!to_resolve_.empty()) {
    Task* task = to_resolve_.front();
    to_resolve_.pop_front();
    resolve(*task);
  }
  draining_ = false;
}

void Session::resolve(Task& task) {
  bool broken = false, unknown = false;
  const auto look = [&](Tree* tree) {
    broken |= tree->state == Tree::State::failed || tree->broken;
    unknown |= tree->unknown;
  };
  const NodeInfo& info = *node(task.node).info;
  for (std::size_t p = 0; p < task.inputs.size(); ++p)
    for (Binding& binding : task.inputs[p]) {
      if (!binding.tree) continue;
      binding.tree = follow(binding.tree);  // a picked element is known only now
      if (!binding.windowed) {
        look(binding.tree);
        continue;
      }
      const Tree::Sequence& around = *binding.tree->sequence;
      const auto [begin, end] = span_of(binding, info.inputs[p]);
      for (std::size_t i = begin; i < end; ++i) look(follow(around.children[i]));
    }
  if (task.prior)
    for (Tree* output : task.prior->outputs) look(output);
  if (broken) return block(task);
  if (unknown) return would_run(task);

  task.key = key_of(task);
  const bool streams =
      std::any_of(info.outputs.begin(), info.outputs.end(), [](const OutputInfo& o) { return o.depth > 0; });
  if (info.cheap && !streams) return install_cheap(task);
  if (const auto outputs = store_.find_outputs(task.key); outputs && outputs->size() == task.outputs.size()) {
    if (!info.cheap) {
      ++counts_.reused;
      emit(RunEvent::Kind::reused, task);
    }
    if (!outputs->empty() && outputs->front().warned) tell_old_warnings(task);
    return install(task, *outputs);
  }
  if (mode_ == Mode::plan) return would_run(task);
  task.state = Task::State::wanted;
  launch(task);
}

// What was worth a warning when a result was made is worth it when the result is used again.
void Session::tell_old_warnings(Task& task) {
  if (mode_ == Mode::plan) return;
  const auto record = store_.find(task.key);
  if (!record) return;
  for (const std::string& warning : record->warnings) emit(RunEvent::Kind::warning, task, warning);
}

// Identities of a task's outputs as a record has them. Elements that were pushed already stay.
void Session::install(Task& task, const std::vector<OutputRecord>& outputs) {
  task.state = Task::State::known;
  const bool cheap = node(task.node).info->cheap;
  const auto fill = [&](Tree* leaf, const Digest& identity, std::size_t output, std::size_t ordinal) {
    leaf->state = Tree::State::leaf;
    leaf->producer = &task;
    leaf->output = static_cast<std::uint32_t>(output);
    leaf->ordinal = static_cast<std::uint32_t>(ordinal);
    leaf->cheap = cheap;
    leaf->identity = identity;
    leaf->has_identity = true;
  };
  const auto cheap_identity = [&](std::size_t output, std::size_t ordinal) {
    Bytes bytes;
    ByteWriter writer(bytes);
    write_digest(writer, task.key);
    writer.count(output);
    writer.count(ordinal);
    return digest_of(bytes);
  };
  for (std::size_t o = 0; o < task.outputs.size(); ++o) {
    Tree* tree = task.outputs[o];
    const OutputRecord& record = outputs[o];
    if (!record.sequence) {
      if (!tree->settled) {
        fill(tree, cheap ? cheap_identity(o, 0) : record.elements.at(0).identity, o, 0);
        settle(tree);
      }
      continue;
    }
    for (std::size_t i = tree->sequence->children.size(); i < record.elements.size(); ++i) {
      Tree* child = new_tree();
      fill(child, cheap ? cheap_identity(o, i) : record.elements[i].identity, o, i);
      child->settled = true;
      add_child(tree, record.elements[i].id, child);
    }
    complete(tree);
  }
  if (!cheap) release_inputs(task);
}

// A cheap task's identities follow from its key: it runs only when somebody must read a value.
void Session::install_cheap(Task& task) {
  std::vector<OutputRecord> outputs(task.outputs.size());
  for (OutputRecord& output : outputs) output.elements.resize(1);
  // Its inputs stay in use, since it may have to run yet: drop_unused() lets them go when its own readers are done.
  install(task, outputs);
}

void Session::block(Task& task) {
  task.state = Task::State::blocked;
  ++counts_.blocked;
  emit(RunEvent::Kind::blocked, task);
  for (Tree* output : task.outputs) fail_tree(output);
  release_inputs(task);
}

void Session::would_run(Task& task) {
  task.state = Task::State::would_run;
  for (Tree* output : task.outputs) {
    output->unknown = true;
    if (output->state == Tree::State::sequence) {
      complete(output);
    } else {
      output->state = Tree::State::leaf;
      settle(output);
    }
  }
}

void Session::each_input_leaf(Task& task, const std::function<void(Tree*)>& visit) {
  const NodeInfo& info = *node(task.node).info;
  for (std::size_t p = 0; p < task.inputs.size(); ++p)
    for (const Binding& binding : task.inputs[p]) {
      if (!binding.tree) continue;
      if (binding.windowed) {
        const Tree::Sequence& around = *binding.tree->sequence;
        const auto [begin, end] = span_of(binding, info.inputs[p]);
        for (std::size_t i = begin; i < end; ++i) visit(follow(around.children[i]));
      } else if (binding.tree->state == Tree::State::leaf) {
        visit(binding.tree);
      }
    }
  if (task.prior)
    for (Tree* output : task.prior->outputs) visit(output);
}

// --- for explain
// ----------------------------------------------------------------------------------------------------------

std::string Session::name_of(const Task& task) const {
  return node(task.node).id + (task.element.empty() ? "" : "[" + task.element + "]");
}

std::vector<KeyPart> Session::parts_with(int node_index, const std::vector<ParamValue>& params) {
  const NodeInfo& info = *node(node_index).info;
  std::vector<KeyPart> parts;
  parts.push_back({"version", std::to_string(info.version), ""});
  parts.push_back({"plugin " + plugins_.plugin_of(info.name), plugins_.digest(info.name).hex(), ""});
  for (std::size_t i = 0; i < params.size(); ++i)
    parts.push_back({"parameter " + info.params[i].name, to_text(params[i]), ""});
  return parts;
}

std::vector<KeyPart> Session::own_parts(const Task& task) { return parts_with(task.node, params_of(task)); }

std::vector<KeyPart> Session::shared_parts(int node_index) { return parts_with(node_index, node(node_index).params); }

std::vector<KeyPart> Session::key_parts(const Task& task) {
  const NodeInfo& info = *node(task.node).info;
  std::vector<KeyPart> parts = own_parts(task);
  const auto origin = [&](Tree* tree) -> std::string {
    if (const auto source = opened_.find(tree); source != opened_.end()) return "file:" + source->second.path;
    if (tree->producer) {
      std::string text = name_of(*tree->producer);
      if (tree->container && tree->producer->outputs[tree->output] != tree) text += "#" + std::to_string(tree->ordinal);
      return text;
    }
    return {};
  };
  for (std::size_t p = 0; p < task.inputs.size(); ++p) {
    const std::string label = "input " + info.inputs[p].name;
    if (task.inputs[p].empty() || !task.inputs[p][0].tree) {
      parts.push_back({label, "absent", ""});
      continue;
    }
    const Binding& binding = task.inputs[p][0];
    if (binding.windowed) {
      const Tree::Sequence& around = *binding.tree->sequence;
      const auto [begin, end] = span_of(binding, info.inputs[p]);
      for (std::size_t i = begin; i < end; ++i)
        parts.push_back({label + "[" + around.ids[i] + "]", identity_of(follow(around.children[i])).hex(),
                         origin(follow(around.children[i]))});
    } else if (binding.tree->state == Tree::State::sequence) {
      // The elements themselves are in the node's history; here only the whole.
      parts.push_back({label, identity_of(binding.tree).hex(), "sequence"});
    } else {
      parts.push_back({label, identity_of(binding.tree).hex(), origin(binding.tree)});
    }
  }
  if (info.prior && task.prior)
    for (std::size_t o = 0; o < task.prior->outputs.size(); ++o)
      parts.push_back(
          {"prior " + info.outputs[o].name, identity_of(task.prior->outputs[o]).hex(), name_of(*task.prior)});
  return parts;
}

}  // namespace engine::run
