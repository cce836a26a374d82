// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <string>

#include "engine/port.h"

namespace engine::run {

class Session;
struct Task;

// What a running task may tell, and be told. cut_short is set when the node was told of the run's end: what it returns
// may then be half a result.
class TaskProgress final : public Progress {
 public:
  TaskProgress(Session& session, Task& task, std::atomic<bool>* cut_short)
      : session_(session), task_(&task), cut_short_(cut_short) {}
  ~TaskProgress() override;
  void turn_to(Task& task);  // the next task of a batch

  void report(double fraction) override;
  bool stop_requested() const override;
  void warn(const std::string& text) override;
  std::string scratch_folder() override;

 private:
  Session& session_;
  Task* task_;
  std::atomic<bool>* cut_short_;
  std::string scratch_;
};

}  // namespace engine::run
