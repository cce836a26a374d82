// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <chrono>
#include <string>

#include "engine/port.h"

namespace engine::run {

class Session;
struct Task;

// What a running task may tell, and be told. cut_short is set when the node was told of the run's end: what it returns
// may then be half a result.
class TaskProgress final : public Progress {
 public:
  TaskProgress(Session& session, Task& task, std::atomic<bool>* cut_short);
  ~TaskProgress() override;
  void turn_to(Task& task);  // the next task of a batch

  void report(double fraction) override;
  bool stop_requested() const override;
  void warn(const std::string& text) override;
  std::string scratch_folder() override;
  // Throws where the task has been told to stop, or hands on an element, after the graph's timeout_s.
  void check_timeout(bool told_only) const;

 private:
  bool late() const;
  Session& session_;
  Task* task_;
  std::atomic<bool>* cut_short_;
  std::string scratch_;
  std::chrono::steady_clock::time_point deadline_;  // the last there is where the graph sets no limit
  mutable std::atomic<bool> told_late_ = false;     // a node may ask from several threads
};

}  // namespace engine::run
