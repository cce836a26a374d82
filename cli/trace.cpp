// SPDX-License-Identifier: Apache-2.0
#include "cli/trace.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/base/problem.h"

namespace cli {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

TraceWriter::TraceWriter(const std::string& path) {
  if (path.empty()) return;
  file_ = std::fopen(path.c_str(), "we");
  if (!file_) throw engine::EngineError("cannot write " + path + ": " + std::strerror(errno));
  std::fputs("[\n", file_);
}

TraceWriter::~TraceWriter() {
  if (!file_) return;
  while (!running_.empty()) {
    const engine::RunEvent task = running_.begin()->second;
    running_.erase(running_.begin());
    slice(task, last_s_, "stopped");
  }
  std::fputs("\n]\n", file_);
  std::fclose(file_);
}

void TraceWriter::name_track(std::uint32_t worker) {
  if (!tracks_.insert(worker).second) return;
  const std::string name = worker == 0 ? "found in the store" : "worker " + std::to_string(worker);
  std::fprintf(
      file_, "%s%s", first_ ? "" : ",\n",
      text_of({{"name", "thread_name"}, {"ph", "M"}, {"pid", 1}, {"tid", worker}, {"args", {{"name", name}}}}).c_str());
  first_ = false;
}

void TraceWriter::slice(const engine::RunEvent& task, double end_s, const char* fate) {
  constexpr double us_per_s = 1e6;
  name_track(task.worker);
  const Json json = {{"name", task.element.empty() ? task.node : task.node + "[" + task.element + "]"},
                     {"cat", task.type},
                     {"ph", "X"},
                     {"pid", 1},
                     {"tid", task.worker},
                     {"ts", task.time_s * us_per_s},
                     {"dur", std::max(0.0, end_s - task.time_s) * us_per_s},
                     {"args", {{"node", task.node}, {"element", task.element}, {"fate", fate}}}};
  std::fprintf(file_, ",\n%s", text_of(json).c_str());
}

void TraceWriter::write(const engine::RunEvent& event) {
  using Kind = engine::RunEvent::Kind;
  if (!file_) return;
  last_s_ = event.time_s;
  const auto end = [&](const char* fate) {
    const auto begun = running_.find(event.worker);
    const bool ran = event.worker > 0 && begun != running_.end() && begun->second.node == event.node &&
                     begun->second.element == event.element;
    slice(ran ? begun->second : event, event.time_s, fate);
    if (ran) running_.erase(begun);
  };
  switch (event.kind) {
    case Kind::started:
      running_[event.worker] = event;
      return;
    case Kind::finished:
    case Kind::made:
      return end("run");
    case Kind::reused:
      return end("reused");
    case Kind::failed:
      return end("failed");
    default:
      return;
  }
}

}  // namespace cli
