// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <cstdio>
#include <map>
#include <set>
#include <string>

#include "engine/run/run.h"

namespace cli {

// Writes a run in the trace format of Chrome, which Perfetto opens: a track for every worker, on it a slice for every
// task (docs/events.md). The file is complete when the object goes; one that a killed process left opens as well.
class TraceWriter {
 public:
  explicit TraceWriter(const std::string& path);  // empty = nowhere
  ~TraceWriter();
  TraceWriter(const TraceWriter&) = delete;
  TraceWriter& operator=(const TraceWriter&) = delete;
  void write(const engine::RunEvent& event);

 private:
  void slice(const engine::RunEvent& task, double end_s, const char* fate);
  void name_track(std::uint32_t worker);

  std::FILE* file_ = nullptr;
  bool first_ = true;
  double last_s_ = 0;
  std::set<std::uint32_t> tracks_;
  std::map<std::uint32_t, engine::RunEvent> running_;  // by worker
};

}  // namespace cli
