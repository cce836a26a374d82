// SPDX-License-Identifier: Apache-2.0
#include "engine/run/task_progress.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "engine/run/session.h"

namespace engine::run {
namespace fs = std::filesystem;

TaskProgress::~TaskProgress() {
  std::error_code ignored;
  if (!scratch_.empty()) fs::remove_all(scratch_, ignored);
}

void TaskProgress::turn_to(Task& task) {
  std::error_code ignored;
  if (!scratch_.empty()) fs::remove_all(scratch_, ignored);
  scratch_.clear();
  task_ = &task;
}

void TaskProgress::report(double fraction) {
  const std::lock_guard guard(session_.mutex_);
  task_->progress = std::clamp(fraction, 0.0, 1.0);
  session_.emit(RunEvent::Kind::progress, *task_);
}

bool TaskProgress::stop_requested() const {
  if (session_.stopped_) *cut_short_ = true;
  return session_.stopped_;
}

void TaskProgress::warn(const std::string& text) {
  const std::lock_guard guard(session_.mutex_);
  task_->warnings.push_back(text);
  session_.emit(RunEvent::Kind::warning, *task_, text);
}

std::string TaskProgress::scratch_folder() {
  if (scratch_.empty()) {
    scratch_ = session_.store_.folder() + "/scratch/" + task_->key.hex() + "-" + std::to_string(::getpid());
    fs::create_directories(scratch_);
  }
  return scratch_;
}

}  // namespace engine::run
