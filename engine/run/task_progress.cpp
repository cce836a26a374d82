// SPDX-License-Identifier: Apache-2.0
#include "engine/run/task_progress.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "engine/run/session.h"
#include "engine/run/values.h"

namespace engine::run {
namespace fs = std::filesystem;

TaskProgress::TaskProgress(Session& session, Task& task, std::atomic<bool>* cut_short)
    : session_(session), cut_short_(cut_short) {
  turn_to(task);
}

TaskProgress::~TaskProgress() {
  std::error_code ignored;
  if (!scratch_.empty()) fs::remove_all(scratch_, ignored);
}

void TaskProgress::turn_to(Task& task) {
  std::error_code ignored;
  if (!scratch_.empty()) fs::remove_all(scratch_, ignored);
  scratch_.clear();
  task_ = &task;
  const double limit_s = session_.graph_.run.timeout_s;
  using clock = std::chrono::steady_clock;
  deadline_ = limit_s > 0 ? clock::now() + std::chrono::duration_cast<clock::duration>(
                                               std::chrono::duration<double>(std::min(limit_s, 1e9)))
                          : clock::time_point::max();
}

bool TaskProgress::late() const {
  return deadline_ != std::chrono::steady_clock::time_point::max() && std::chrono::steady_clock::now() > deadline_;
}

void TaskProgress::check_timeout(bool told_only) const {
  if (!(told_only ? told_late_.load() : late())) return;
  std::ostringstream text;
  text << "it ran longer than the graph's timeout_s of " << session_.graph_.run.timeout_s << " s";
  throw std::runtime_error(text.str());
}

void TaskProgress::report(double fraction) {
  const std::lock_guard guard(session_.mutex_);
  task_->progress = std::clamp(fraction, 0.0, 1.0);
  session_.emit(RunEvent::Kind::progress, *task_);
}

bool TaskProgress::stop_requested() const {
  if (session_.stopped_) *cut_short_ = true;
  if (late()) told_late_ = true;
  return session_.stopped_ || told_late_;
}

void TaskProgress::warn(const std::string& text) {
  const std::lock_guard guard(session_.mutex_);
  task_->warnings.push_back(text);
  session_.emit(RunEvent::Kind::warning, *task_, text);
}

std::string TaskProgress::scratch_folder() {
  if (scratch_.empty()) {
    scratch_ = scratch_root(session_.store_) + "/" + task_->key.hex() + "-" + std::to_string(::getpid());
    fs::create_directories(scratch_);
  }
  return scratch_;
}

}  // namespace engine::run
