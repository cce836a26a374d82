// SPDX-License-Identifier: Apache-2.0
// The threads that run tasks: which task is next, and who waits for what.
#include <algorithm>
#include <system_error>

#include "engine/run/session.h"

namespace engine::run {
using namespace std::chrono_literals;

// Depth first: what is nearest to the outputs, then what was made first.
bool Session::Later::operator()(const Task* a, const Task* b) const {
  return a->node != b->node ? a->node < b->node : a->serial > b->serial;
}

void Session::enqueue(Task& task) {
  task.state = Task::State::ready;
  ready_.push(&task);
  changed_.notify_all();
}

// Another process computes the task: whatever else there is to do comes first, and the key is looked at now and then.
void Session::postpone(Task& task) {
  constexpr int most_doublings = 4;  // 2 ms ... 32 ms
  task.state = Task::State::ready;
  held_.push({std::chrono::steady_clock::now() + 2ms * (1 << std::min<int>(task.refusals, most_doublings)), &task});
  if (task.refusals < most_doublings) ++task.refusals;
}

void Session::readmit() {
  while (!held_.empty() && held_.top().until <= std::chrono::steady_clock::now()) {
    ready_.push(held_.top().task);
    held_.pop();
  }
}

void Session::start_worker() {
  if (alive_ == 0) {
    // Whoever was there before has let go of the lock for good.
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }
  try {
    threads_.emplace_back([this] { worker(); });
    ++alive_;
  } catch (const std::system_error&) {
    if (alive_ == 0) throw;  // else those that run do the work
  }
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
  const std::uint32_t number = ++started_workers_;
  while (!stopped_) {
    readmit();
    if (ready_.empty() || active_ >= most_workers_) {
      if (idle()) break;
      auto until = std::chrono::steady_clock::now() + 200ms;
      if (ready_.empty() && !held_.empty()) until = std::min(until, held_.top().until);
      changed_.wait_until(guard, until);
      continue;
    }
    Task* task = ready_.top();
    ready_.pop();
    ++active_;
    ++running_;
    task->worker = number;
    try {
      run_task(*task, guard);
    } catch (...) {
      // Of the engine's own work around the task: the store, or no memory.
      if (!guard.owns_lock()) guard.lock();
      if (!fatal_) fatal_ = std::current_exception();
      task->state = Task::State::failed;
    }
    --running_;
    --active_;
    changed_.notify_all();
    if (fatal_ || idle()) ended_.notify_all();
  }
  --alive_;
  changed_.notify_all();
  ended_.notify_all();
}

void Session::work() {
  std::unique_lock guard(mutex_);
  for (int i = 0; i < most_workers_ && !idle(); ++i) start_worker();
  while (!idle() && !stopped_ && !fatal_) {
    ended_.wait_for(guard, 50ms);
    if (options_.stop_requested && options_.stop_requested()) stopped_ = true;
  }
  if (fatal_) stopped_ = true;
  changed_.notify_all();
  // A node that does not look at its stop request would hold the process: whoever asked for the stop may leave at once.
  const auto patience = std::chrono::steady_clock::now() + 700ms;
  while (running_ > 0 && stopped_) {
    if (ended_.wait_until(guard, patience) == std::cv_status::timeout && running_ > 0) {
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

// Waits without holding a worker's place: another thread takes it.
void Session::wait_blocked(std::unique_lock<std::mutex>& guard, const std::function<bool()>& until) {
  if (until()) return;
  if (alive_ - blocked_ - 1 < most_workers_ && !stopped_) start_worker();
  ++blocked_;
  --active_;
  changed_.notify_all();
  while (!until() && !stopped_) changed_.wait_for(guard, 200ms);
  ++active_;
  --blocked_;
}

// Back-pressure: while the budget is exceeded and something else goes on, the producer waits, and another worker takes
// its place; when nothing else goes on, values that can be made again go, and the budget is exceeded rather than never
// reached. What another process holds does not count as going on: it may wait for the producer's key.
void Session::throttle(std::unique_lock<std::mutex>& guard) {
  make_room(false);
  if (used_ <= budget_) return;
  wait_blocked(guard, [&] { return used_ <= budget_ || (running_ <= blocked_ && ready_.empty()); });
  if (stopped_) throw Stopped{};
  if (used_ > budget_) make_room(true);
}

}  // namespace engine::run
