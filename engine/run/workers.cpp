// SPDX-License-Identifier: Apache-2.0
// The threads that run tasks: which task is next, and who waits for what.
#include <algorithm>
#include <system_error>

#include "engine/run/session.h"

namespace engine::run {
using namespace std::chrono_literals;
namespace {

thread_local std::uint32_t worker_number = 0;  // of this thread, from 1

}  // namespace

std::uint32_t Session::current_worker() { return worker_number; }

// What a running task waits for, then depth first: what is nearest to the outputs, then what was made first.
bool Session::Before::operator()(const Task* a, const Task* b) const {
  if (a->awaited != b->awaited) return a->awaited;
  return a->node != b->node ? a->node > b->node : a->serial < b->serial;
}

void Session::enqueue(Task& task) {
  task.state = Task::State::ready;
  ready_.insert(&task);
}

// Another worker takes what this thread will not take soon. One that naps looks by itself: waking it for each of many
// small tasks would cost more than they do.
void Session::wake_worker() {
  constexpr std::size_t most_left_to_nappers = 512;
  if (ready_.empty() || sleeping_ == 0 || active_ >= most_workers_) return;
  if (napping_ > 0 && ready_.size() < most_left_to_nappers && is_light(next_ready().node)) return;
  work_.notify_one();
}

// Whoever waits for a value, or for memory, looks again.
void Session::tell_blocked() {
  if (blocked_ > 0) changed_.notify_all();
}

// Another process computes the task: whatever else there is to do comes first, and the key is looked at now and then.
void Session::postpone(Task& task) {
  constexpr int most_doublings = 4;  // 2 ms ... 32 ms
  task.state = Task::State::ready;
  held_.push({std::chrono::steady_clock::now() + 2ms * (1 << std::min<int>(task.refusals, most_doublings)), &task});
  if (task.refusals < most_doublings) ++task.refusals;
  if (sleeping_ > 0) work_.notify_one();  // it sleeps until the next is due
}

void Session::readmit() {
  while (!held_.empty() && held_.top().until <= std::chrono::steady_clock::now()) {
    ready_.insert(held_.top().task);
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
  constexpr int naps = 16;
  std::unique_lock guard(mutex_);
  worker_number = ++started_workers_;
  int naps_left = 0;  // small tasks were here, and more may come
  while (!stopped_) {
    readmit();
    if (ready_.empty() || active_ >= most_workers_) {
      if (idle()) break;
      const bool nap = naps_left > 0 && ready_.empty();
      auto until = std::chrono::steady_clock::now() + (nap ? std::chrono::microseconds(500) : 200ms);
      if (ready_.empty() && !held_.empty()) until = std::min(until, held_.top().until);
      naps_left -= nap;
      ++sleeping_;
      napping_ += nap;
      work_.wait_until(guard, until);
      napping_ -= nap;
      --sleeping_;
      continue;
    }
    ++active_;
    ++running_;
    if (suits_batch(next_ready())) {
      naps_left = naps;
      try {
        run_batch(guard);
      } catch (...) {
        if (!guard.owns_lock()) guard.lock();
        if (!fatal_) fatal_ = std::current_exception();
      }
    } else {
      Task* task = &next_ready();
      ready_.erase(ready_.begin());
      wake_worker();
      task->worker = worker_number;
      try {
        run_task(*task, guard);
      } catch (...) {
        // Of the engine's own work around the task: the store, or no memory.
        if (!guard.owns_lock()) guard.lock();
        if (!fatal_) fatal_ = std::current_exception();
        task->state = Task::State::failed;
      }
    }
    --running_;
    --active_;
    tell_blocked();
    if (fatal_ || idle()) {
      ended_.notify_all();
      work_.notify_all();
    }
  }
  --alive_;
  tell_blocked();
  wake_worker();
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
  work_.notify_all();
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
  if (!ready_.empty()) work_.notify_one();
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
