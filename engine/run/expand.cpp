// SPDX-License-Identifier: Apache-2.0
// Trees grow: sources, levels of mapping, tasks.
#include <algorithm>
#include <stdexcept>

#include "engine/base/element_id.h"
#include "engine/run/session.h"

namespace engine::run {
namespace {

std::string join(const std::string& path, const std::string& id) { return path.empty() ? id : path + "/" + id; }

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts;
  std::size_t at = 0;
  while (at <= path.size()) {
    const std::size_t slash = std::min(path.find('/', at), path.size());
    parts.push_back(path.substr(at, slash - at));
    at = slash + 1;
  }
  return parts;
}

}  // namespace

bool in_range(const std::string& id, const std::string& first, const std::string& last) {
  if (first == last) return id == first;
  return is_integer_id(id) && !id_before(id, first) && !id_before(last, id);
}

Span span_of(const Binding& binding, const InputInfo& port) {
  const std::size_t before = std::min(binding.index, static_cast<std::size_t>(port.before));
  return {binding.index - before,
          std::min(binding.tree->sequence->children.size(), binding.index + static_cast<std::size_t>(port.after) + 1)};
}

ElementFilter::ElementFilter(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    std::vector<std::string> parts = split(text);
    Override::Range range;
    const std::string leaf = parts.back();
    parts.pop_back();
    for (const std::string& part : parts) range.parents.push_back(canonical_id(part));
    const std::size_t dash = leaf.find('-');
    range.first = range.last = canonical_id(leaf);
    if (range.first.empty() && dash != std::string::npos) {
      range.first = canonical_id(leaf.substr(0, dash));
      range.last = canonical_id(leaf.substr(dash + 1));
    }
    if (range.first.empty() || range.last.empty())
      throw std::invalid_argument("'" + text + "' is no element: expected an id, a range such as 0-49, or parent/id");
    ranges_.push_back(std::move(range));
  }
}

bool ElementFilter::admits(const std::string& path) const {
  const std::vector<std::string> ids = split(path);
  for (const Override::Range& range : ranges_) {
    bool fits = true;
    for (std::size_t i = 0; i < ids.size() && fits; ++i) {
      if (i < range.parents.size())
        fits = ids[i] == range.parents[i];
      else if (i == range.parents.size())
        fits = in_range(ids[i], range.first, range.last);
    }
    if (fits) return true;
  }
  return false;
}

// --- trees
// ------------------------------------------------------------------------------------------------------------

Tree* Session::new_tree() { return &trees_.emplace_back(); }

Tree* Session::new_sequence() {
  Tree* tree = new_tree();
  tree->state = Tree::State::sequence;
  tree->sequence = std::make_unique<Tree::Sequence>();
  return tree;
}

void Session::add_child(Tree* sequence, std::string id, Tree* child) {
  child = follow(child);
  Tree::Sequence& held = *sequence->sequence;
  held.ids.push_back(std::move(id));
  held.children.push_back(child);
  if (!child->container) child->container = sequence;
  if (child->settled) {
    if (child->state == Tree::State::failed || child->broken) sequence->broken = true;
    if (child->unknown) sequence->unknown = true;
  } else {
    ++held.unsettled;
    child->containers.push_back(sequence);
  }
  notify_growth(sequence);
}

void Session::complete(Tree* sequence) {
  if (sequence->state == Tree::State::failed || sequence->sequence->complete) return;
  sequence->sequence->complete = true;
  notify_growth(sequence);
  if (sequence->sequence->unsettled == 0) settle(sequence);
}

void Session::notify_growth(Tree* tree) {
  for (std::size_t i = 0; i < tree->on_grow.size(); ++i) tree->on_grow[i]->update(tree);
}

void Session::settle(Tree* tree) {
  if (tree->settled) return;
  tree->settled = true;
  const bool bad = tree->state == Tree::State::failed || tree->broken;
  for (Tree* container : tree->containers) {
    if (bad) container->broken = true;
    if (tree->unknown) container->unknown = true;
    if (--container->sequence->unsettled == 0 && container->sequence->complete) settle(container);
  }
  tree->containers.clear();
  std::vector<Watcher*> watchers = std::move(tree->on_settle);
  for (Watcher* watcher : watchers) watcher->update(tree);
}

void Session::fail_tree(Tree* tree) {
  if (tree->settled) return;
  if (tree->state == Tree::State::sequence) {
    tree->broken = true;
    tree->sequence->cut_off = true;
    if (!tree->sequence->complete) complete(tree);
    return;
  }
  tree->state = Tree::State::failed;
  notify_growth(tree);
  settle(tree);
}

void Session::set_forward(Tree* tree, Tree* target) {
  target = follow(target);
  tree->forward = target;
  // Who reads a tree that was pending did not know yet whether it is one value or many.
  if (target->state == Tree::State::sequence)
    target->sequence->gathers += tree->uses;
  else
    target->uses += tree->uses;
  for (Tree* container : tree->containers) {
    std::replace(container->sequence->children.begin(), container->sequence->children.end(), tree, target);
    if (!target->settled) {
      target->containers.push_back(container);
    } else {
      if (target->state == Tree::State::failed || target->broken) container->broken = true;
      if (target->unknown) container->unknown = true;
      if (--container->sequence->unsettled == 0 && container->sequence->complete) settle(container);
    }
  }
  std::vector<Watcher*> growth = std::move(tree->on_grow);
  std::vector<Watcher*> settling = std::move(tree->on_settle);
  for (Watcher* watcher : growth) watch_growth(target, watcher);
  for (Watcher* watcher : settling)
    if (!watch_settling(target, watcher)) watcher->update(target);
}

// Tells the watcher at once of what is there already.
void Session::watch_growth(Tree* tree, Watcher* watcher) {
  tree = follow(tree);
  tree->on_grow.push_back(watcher);
  if (tree->state != Tree::State::pending) watcher->update(tree);
}

bool Session::watch_settling(Tree* tree, Watcher* watcher) {
  tree = follow(tree);
  if (tree->settled) return false;
  tree->on_settle.push_back(watcher);
  return true;
}

Tree* Session::source_tree(const Source& source) {
  const auto known = sources_.find(source.path);
  if (known != sources_.end()) return known->second;
  SourceFile opened = open_source(source.path, store_);
  Tree* tree = new_tree();
  tree->state = Tree::State::leaf;
  tree->source = true;
  tree->settled = true;
  tree->identity = opened.identity;
  tree->has_identity = true;
  tree->value = Value::of(std::move(opened.file));
  sources_[source.path] = tree;
  opened_[tree] = {source.path, std::move(opened.paths)};
  return tree;
}

Tree* Session::output_tree(const Source& source) {
  if (source.kind == Source::Kind::file) return source_tree(source);
  Tree* tree = outputs_[static_cast<std::size_t>(source.node)][static_cast<std::size_t>(source.output)];
  if (source.element.empty()) return tree;
  Tree* picked = new_tree();
  std::string shown = node(source.node).id + "[";
  for (std::size_t i = 0; i < source.element.size(); ++i) shown += (i == 0 ? "" : "/") + source.element[i];
  watchers_.push_back(std::make_unique<Pick>(*this, tree, source.element, picked, shown + "]"));
  watch_growth(tree, watchers_.back().get());
  return picked;
}

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
    const std::vector<std::string> ids = split(path);
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

// --- levels of mapping
// --------------------------------------------------------------------------------------------------

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
  for (Driver& driver : sparse_) {
    driver.tree = follow(driver.tree);
    if (driver.tree->state != Tree::State::sequence || !driver.tree->sequence->complete) return false;
  }
  for (Driver& driver : required_) {
    const Tree::Sequence& held = *driver.tree->sequence;
    if (held.children.size() <= index) return false;
    if (driver.window && held.children.size() <= index + static_cast<std::size_t>(driver.after) && !held.complete)
      return false;
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
  const std::string path = join(path_, id);
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
  for (const Driver& driver : sparse_)
    for (const std::string& id : driver.tree->sequence->ids)
      if (!lead.positions.contains(id))
        return fail_level("input '" + graph_node.info->inputs[driver.port].name + "' has an element '" + id +
                          "' that input '" + graph_node.info->inputs[required_[0].port].name + "' has not");
  done_ = true;
  for (Tree* output : outputs_) {
    if (broken) output->broken = output->sequence->cut_off = true;
    for (const Driver& driver : required_)
      if (driver.tree->unknown && driver.tree->sequence->children.empty()) output->unknown = true;
    session_.complete(output);
  }
}

// --- picking one element
// --------------------------------------------------------------------------------------------------

Pick::Pick(Session& session, Tree* from, std::vector<std::string> ids, Tree* to, std::string shown)
    : session_(session), from_(from), ids_(std::move(ids)), to_(to), shown_(std::move(shown)) {}

void Pick::update(Tree*) {
  while (!done_) {
    from_ = follow(from_);
    if (from_->state == Tree::State::failed) {
      done_ = true;
      session_.fail_tree(to_);
      return;
    }
    if (from_->state != Tree::State::sequence) return;
    const Tree::Sequence& held = *from_->sequence;
    while (seen_ < held.ids.size() && held.ids[seen_] != ids_.front()) ++seen_;
    if (seen_ == held.ids.size()) {
      if (!held.complete) return;
      done_ = true;
      if (from_->unknown) {
        to_->unknown = true;
      } else if (!from_->broken) {
        session_.note_failure(shown_ + ": there is no element '" + ids_.front() + "'; the sequence has " +
                              std::to_string(held.ids.size()) + " elements" +
                              (held.ids.empty() ? "" : ", '" + held.ids.front() + "' to '" + held.ids.back() + "'"));
        ++session_.counts_.failed;
      }
      session_.fail_tree(to_);
      return;
    }
    Tree* child = held.children[seen_];
    ids_.erase(ids_.begin());
    seen_ = 0;
    if (ids_.empty()) {
      done_ = true;
      session_.set_forward(to_, child);
      return;
    }
    from_ = child;
    session_.watch_growth(child, this);
    return;
  }
}

}  // namespace engine::run
