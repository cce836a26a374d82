// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdio>
#include <string>

#include "engine/run/run.h"

namespace cli {

// Writes a run's events as NDJSON, a line each: {"event": "finished", "time_s": 0.12, "node": "flow", ...}.
class EventWriter {
 public:
  explicit EventWriter(const std::string& path);  // "-" = standard output; empty = nowhere
  ~EventWriter();
  void write(const engine::RunEvent& event);

 private:
  std::FILE* file_ = nullptr;
  bool failed_ = false;
};

// Throws where the file cannot be written: told before the run, not after it.
void check_writable(const std::string& path);

// {"tasks": {"run": 4, "reused": 747, "failed": 0, "blocked": 0}, "seconds": 0.8}
void write_summary(const std::string& path, const engine::RunResult& result);

}  // namespace cli
