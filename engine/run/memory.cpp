// SPDX-License-Identifier: Apache-2.0
// Values in memory: asked for, held, given up.
#include <malloc.h>

#include <algorithm>

#include "engine/run/session.h"

namespace engine::run {
namespace {

constexpr std::size_t trim_every_bytes = 256 << 20;

// What one thread's heap has given up is of no use to the others, which grow on beside it: a second pass over a film
// took as much again as the first. Heaps in which values come and go at one pace have little to give back.
void trim_heaps() {
  if (::mallinfo2().fordblks > trim_every_bytes) ::malloc_trim(0);
}

}  // namespace

bool Session::available(Tree* leaf) {
  return leaf->source || leaf->value || (!leaf->cheap && leaf->has_identity && store_.has(leaf->identity));
}

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
  await(*leaf->producer);
  produce(*leaf->producer);
  if (sequence) read_ahead(*sequence, index);
  drain();
  const auto there = [&] { return static_cast<bool>(leaf->value) || leaf->producer->state == Task::State::failed; };
  // Small tasks are done before another thread has woken; none of them waits for anything.
  while (!there() && !stopped_ && !ready_.empty() && suits_batch(next_ready())) run_batch(guard);
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
  // One for every worker, so that they go on while the reader works with this one.
  const std::size_t ahead = is_light(first->producer->node) ? small_tasks : static_cast<std::size_t>(most_workers_);
  for (std::size_t i = index + 1; i <= std::min(children.size() - 1, index + ahead) && used_ < budget_; ++i) {
    const Tree* next = follow(children[i]);
    if (next->state == Tree::State::leaf && next->cheap && !next->value &&
        next->producer->node == first->producer->node)
      produce(*next->producer);
  }
}

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
  dropped_ += leaf->bytes;
  if (dropped_ >= trim_every_bytes) {
    dropped_ = 0;
    trim_heaps();
  }
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

bool Session::wanted(const Tree* leaf) const {
  return leaf->uses > 0 || leaf->pins > 0 || !leaf->requests.empty() ||
         (leaf->container && leaf->container->sequence && leaf->container->sequence->gathers > 0);
}

// A value that nobody needs leaves the memory; if its task is cheap, that task needs its own inputs no more.
void Session::drop_unused(Tree* leaf) {
  if (leaf->source || wanted(leaf)) return;
  drop_value(leaf);
  Task* producer = leaf->producer;
  if (!producer || !leaf->cheap || producer->released || producer->state != Task::State::known) return;
  for (Tree* output : producer->outputs)
    if (output->state == Tree::State::sequence || wanted(output)) return;
  release_inputs(*producer);
}

// The task reads its inputs no more.
void Session::release_inputs(Task& task) {
  if (task.released) return;
  task.released = true;
  each_input_leaf(task, [&](Tree* leaf) {
    if (leaf->uses > 0) --leaf->uses;
    drop_unused(leaf);
  });
  for (const auto& port : task.inputs)
    for (const Binding& binding : port) {
      if (!binding.tree || binding.windowed || binding.tree->state != Tree::State::sequence) continue;
      Tree::Sequence& held = *binding.tree->sequence;
      if (held.gathers > 0 && --held.gathers == 0)
        for (Tree* child : held.children)
          if (follow(child)->state == Tree::State::leaf) drop_unused(follow(child));
    }
}

}  // namespace engine::run
