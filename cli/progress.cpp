// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include <unistd.h>

#include <cstdio>

namespace cli {
namespace {

constexpr double redraw_s = 0.1;  // a terminal
constexpr double report_s = 5.0;  // a log
constexpr std::size_t most_alike = 5;

// What a task said, without its element: "failed: flow: ..."
std::string without_element(const engine::RunEvent& event) {
  std::string said = event.text;
  if (event.kind == engine::RunEvent::Kind::warning) return "warning: " + event.node + ": " + said;
  if (const std::size_t key = said.rfind(" [key "); key != std::string::npos) said.resize(key);
  if (const std::string start = task_name(event) + " (" + event.type + "): "; said.starts_with(start))
    said.erase(0, start.size());
  return "failed: " + event.node + ": " + said;
}

}  // namespace

ProgressPrinter::ProgressPrinter(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {}

void ProgressPrinter::clear() {
  if (drawn_) std::fprintf(stderr, "\r\033[K");
  drawn_ = false;
}

void ProgressPrinter::finish() {
  clear();
  for (const auto& [said, count] : alike_)
    if (count > most_alike) std::fprintf(stderr, "%s (the same of %zu more)\n", said.c_str(), count - most_alike);
  alike_.clear();
}

void ProgressPrinter::tell(const engine::RunEvent& event) {
  if (++alike_[without_element(event)] > most_alike) return;
  clear();
  if (event.kind == engine::RunEvent::Kind::failed)
    std::fprintf(stderr, "failed: %s\n", event.text.c_str());
  else
    std::fprintf(stderr, "warning: %s: %s\n", task_name(event).c_str(), event.text.c_str());
}

void ProgressPrinter::show(const engine::RunEvent& event) {
  using Kind = engine::RunEvent::Kind;
  if (event.kind == Kind::failed || event.kind == Kind::warning) tell(event);
  if (quiet_) return;
  pace_.see(event);
  const double wait = terminal_ ? redraw_s : report_s;
  if (last_s_ >= 0 && event.time_s - last_s_ < wait) return;
  if (last_s_ < 0) {
    last_s_ = 0;
    if (!terminal_) return;
  }
  last_s_ = event.time_s;
  bar(event);
}

void ProgressPrinter::bar(const engine::RunEvent& event) {
  const double share = event.known == 0 ? 0 : static_cast<double>(event.done) / static_cast<double>(event.known);
  const std::string left = pace_.left(event);
  if (!terminal_) {
    std::fprintf(stderr, "%zu of %zu tasks, %s  %s\n", event.done, event.known, pace_.task(event).c_str(),
                 left.c_str());
    return;
  }
  constexpr int width = 30;
  const int full = static_cast<int>(share * width);
  std::string text(static_cast<std::size_t>(full), '#');
  text.resize(width, '.');
  std::fprintf(stderr, "\r\033[K[%s] %zu/%zu  %s  %s", text.c_str(), event.done, event.known, pace_.task(event).c_str(),
               left.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace cli
