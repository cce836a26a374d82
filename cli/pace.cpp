// SPDX-License-Identifier: Apache-2.0
#include "cli/pace.h"

#include <algorithm>

namespace cli {
namespace {

constexpr double least_share = 0.02;  // of the work, before a time is foretold from it

}  // namespace

std::string task_name(const engine::RunEvent& event) {
  return event.element.empty() ? event.node : event.node + "[" + event.element + "]";
}

void Pace::see(const engine::RunEvent& event) {
  using Kind = engine::RunEvent::Kind;
  switch (event.kind) {
    case Kind::started:
      running_[task_name(event)] = {event.time_s, 0};
      break;
    case Kind::progress: {
      const auto found = running_.find(task_name(event));
      if (found != running_.end()) found->second.fraction = event.fraction;
      break;
    }
    case Kind::reused:
      ++reused_;
      [[fallthrough]];
    case Kind::finished:
    case Kind::made:
    case Kind::failed:
      if (!running_.empty()) running_.erase(task_name(event));
      break;
    case Kind::blocked:
    case Kind::warning:
      break;
  }
}

double Pace::rest_s(const Running& running, double now_s) {
  if (running.fraction < least_share) return -1;
  return (now_s - running.since_s) * (1 - running.fraction) / running.fraction;
}

std::string Pace::task(const engine::RunEvent& event) const {
  double longest_s = -1;
  std::string text = task_name(event);
  for (const auto& [name, running] : running_)
    if (const double seconds = rest_s(running, event.time_s); seconds > longest_s) {
      longest_s = seconds;
      text = name + " " + std::to_string(static_cast<int>(running.fraction * 100)) + " %";
    }
  return text;
}

std::string Pace::left(const engine::RunEvent& event) const {
  double seconds = -1;
  for (const auto& [name, running] : running_) seconds = std::max(seconds, rest_s(running, event.time_s));
  const double ran = static_cast<double>(event.done - std::min(event.done, reused_));
  const double to_run = static_cast<double>(event.known - std::min(event.known, reused_));
  const double waiting = static_cast<double>(event.known - event.done) - static_cast<double>(running_.size());
  if (waiting > 0 && to_run > 0 && ran / to_run > least_share && event.time_s > 1)
    seconds = std::max(seconds, event.time_s * (to_run - ran) / ran);
  if (seconds < 0) return "";
  return seconds < 90 ? std::to_string(static_cast<int>(seconds + 0.5)) + " s left"
                      : std::to_string(static_cast<int>(seconds / 60 + 0.5)) + " min left";
}

}  // namespace cli
