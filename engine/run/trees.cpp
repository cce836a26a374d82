// SPDX-License-Identifier: Apache-2.0
// Trees of values: how they grow, settle and fail.
#include <algorithm>

#include "engine/run/session.h"

namespace engine::run {

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

}  // namespace engine::run
