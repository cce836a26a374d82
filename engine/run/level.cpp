// SPDX-License-Identifier: Apache-2.0
// Levels of mapping.
#include <algorithm>

#include "engine/run/session.h"

namespace engine::run {

Level::Level(Session& session, int node, Bindings inputs, std::string path, std::vector<Tree*> outputs)
    : session_(session), node_(node), inputs_(std::move(inputs)), path_(std::move(path)), outputs_(std::move(outputs)) {
  const NodeInfo& info = *session_.node(node_).info;
  for (std::size_t p = 0; p < inputs_.size(); ++p)
    for (std::size_t s = 0; s < inputs_[p].size(); ++s) {
      Binding& binding = inputs_[p][s];
      if (!binding.tree || binding.excess == 0) continue;
      const InputInfo& port = info.inputs[p];
      const Driver driver{p, s, binding.tree, port.window && binding.excess == 1, port.before, port.after};
      (port.optional ? sparse_ : required_).push_back(driver);
    }
  if (required_.empty()) {
    required_.push_back(sparse_.front());
    sparse_.erase(sparse_.begin());
  }
}

void Level::start() {
  for (const std::vector<Driver>* drivers : {&required_, &sparse_})
    for (const Driver& driver : *drivers) session_.watch_growth(driver.tree, this);
}

bool Level::ready_for(std::size_t index) {
  const auto lacks_what_follows = [](const Driver& driver, std::size_t at) {
    const Tree::Sequence& held = *driver.tree->sequence;
    return driver.window && held.children.size() <= at + static_cast<std::size_t>(driver.after) && !held.complete;
  };
  for (const Driver& driver : required_)
    if (driver.tree->sequence->children.size() <= index || lacks_what_follows(driver, index)) return false;
  // An element that is there need not wait for the end of its sequence; only then it is known that there is none.
  for (Driver& driver : sparse_) {
    driver.tree = follow(driver.tree);
    if (driver.tree->state != Tree::State::sequence) return false;
    Tree::Sequence& held = *driver.tree->sequence;
    if (held.complete) continue;
    held.index();
    const auto at = held.positions.find(required_[0].tree->sequence->ids[index]);
    if (at == held.positions.end() || lacks_what_follows(driver, at->second)) return false;
  }
  return true;
}

void Level::update(Tree*) {
  if (done_) return;
  for (std::vector<Driver>* drivers : {&required_, &sparse_})
    for (Driver& driver : *drivers) {
      driver.tree = follow(driver.tree);
      if (driver.tree->state == Tree::State::pending) return;
      // An optional sequence that broke off is not one without elements.
      const bool lost =
          drivers == &sparse_ && driver.tree->state == Tree::State::sequence && driver.tree->sequence->cut_off;
      if (driver.tree->state == Tree::State::failed || lost) {
        done_ = true;
        for (Tree* output : outputs_) session_.fail_tree(output);
        ++session_.counts_.blocked;
        return;
      }
    }
  while (!done_ && ready_for(made_)) add(made_++);
  if (!done_) finish();
}

void Level::fail_level(const std::string& text) {
  done_ = true;
  session_.note_failure(session_.node(node_).id + (path_.empty() ? "" : "[" + path_ + "]") + ": " + text);
  ++session_.counts_.failed;
  for (Tree* output : outputs_) session_.fail_tree(output);
}

void Level::add(std::size_t index) {
  const GraphNode& graph_node = session_.node(node_);
  const std::string& id = required_[0].tree->sequence->ids[index];
  for (const Driver& driver : required_)
    if (driver.tree->sequence->ids[index] != id)
      return fail_level("inputs '" + graph_node.info->inputs[required_[0].port].name + "' and '" +
                        graph_node.info->inputs[driver.port].name + "' have different ids: at position " +
                        std::to_string(index) + " the first has '" + id + "', the second '" +
                        driver.tree->sequence->ids[index] + "'");
  const std::string path = path_.empty() ? id : path_ + "/" + id;
  if (session_.filtered_[static_cast<std::size_t>(node_)] && !session_.filter_.admits(path)) {
    // Nobody asked for it: its place is kept, so that positions still agree, and stays empty.
    for (Tree* output : outputs_) session_.add_child(output, id, session_.new_tree());
    return;
  }

  Bindings inputs = inputs_;
  const auto descend = [&](const Driver& driver, std::size_t at) {
    Binding& binding = inputs[driver.port][driver.source];
    --binding.excess;
    if (driver.window) {
      binding.windowed = true;
      binding.tree = driver.tree;
      binding.index = at;
    } else {
      binding.tree = driver.tree->sequence->children[at];
    }
  };
  for (const Driver& driver : required_) descend(driver, index);
  for (const Driver& driver : sparse_) {
    Tree::Sequence& held = *driver.tree->sequence;
    held.index();
    const auto at = held.positions.find(id);
    if (at == held.positions.end()) {
      Binding& binding = inputs[driver.port][driver.source];
      binding = {};
      if (driver.tree->unknown) binding.tree = driver.tree;  // in a plan: it may get the element
    } else {
      descend(driver, at->second);
    }
  }
  // A level below this one, or a streamed output, makes the element a sequence.
  bool deeper = false;
  for (const auto& port : inputs)
    for (const Binding& binding : port) deeper |= binding.tree && binding.excess > 0;
  std::vector<Tree*> outputs;
  for (std::size_t o = 0; o < outputs_.size(); ++o) {
    Tree* child = deeper || graph_node.info->outputs[o].depth > 0 ? session_.new_sequence() : session_.new_tree();
    child->container = outputs_[o];
    outputs.push_back(child);
  }
  Task* made = nullptr;
  session_.instantiate(node_, std::move(inputs), path, outputs, &made, last_, graph_node.info->prior);
  if (made) last_ = made;
  for (std::size_t o = 0; o < outputs_.size(); ++o) session_.add_child(outputs_[o], id, outputs[o]);
}

void Level::finish() {
  for (const Driver& driver : required_)
    if (!driver.tree->sequence->complete) return;
  for (const Driver& driver : sparse_)
    if (!driver.tree->sequence->complete) return;
  const GraphNode& graph_node = session_.node(node_);
  Tree::Sequence& lead = *required_[0].tree->sequence;
  bool broken = false;
  for (const Driver& driver : required_) {
    const Tree::Sequence& held = *driver.tree->sequence;
    // A sequence that broke off is as long as it is: what follows is lost already.
    broken |= held.cut_off || (driver.tree->broken && held.ids.size() != lead.ids.size());
    if (held.ids.size() == lead.ids.size() || driver.tree->broken || required_[0].tree->broken) continue;
    const bool shorter = held.ids.size() < lead.ids.size();
    const std::string& odd = shorter ? lead.ids[held.ids.size()] : held.ids[lead.ids.size()];
    return fail_level("inputs '" + graph_node.info->inputs[required_[0].port].name + "' and '" +
                      graph_node.info->inputs[driver.port].name + "' have different ids: '" + odd +
                      "' is only in the " + (shorter ? "first" : "second") + " (" + std::to_string(lead.ids.size()) +
                      " and " + std::to_string(held.ids.size()) + " elements)");
  }
  if (!sparse_.empty()) lead.index();
  // What could not be made lacks elements without having a word in it.
  const bool whole = !broken && !required_[0].tree->broken;
  for (const Driver& driver : sparse_)
    for (const std::string& id : driver.tree->sequence->ids)
      if (whole && !lead.positions.contains(id))
        return fail_level("input '" + graph_node.info->inputs[driver.port].name + "' has an element '" + id +
                          "' that input '" + graph_node.info->inputs[required_[0].port].name + "' has not, which has " +
                          (lead.ids.empty() ? "none" : "'" + lead.ids.front() + "' to '" + lead.ids.back() + "'"));
  done_ = true;
  for (Tree* output : outputs_) {
    if (broken) output->broken = output->sequence->cut_off = true;
    for (const Driver& driver : required_)
      if (driver.tree->unknown && driver.tree->sequence->children.empty()) output->unknown = true;
    session_.complete(output);
  }
}

}  // namespace engine::run
