// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdio>
#include <mutex>
#include <string>

#include "engine/run/run.h"

namespace cli {

// Shows a run: a bar with the time left on a terminal, plain lines elsewhere.
class ProgressPrinter {
 public:
  explicit ProgressPrinter(bool quiet);
  void show(const engine::RunEvent& event);
  void clear();

 private:
  void bar(const engine::RunEvent& event);
  bool quiet_;
  bool terminal_;
  double last_s_ = -1;
  std::size_t settled_at_start_ = 0;
  bool drawn_ = false;
};

}  // namespace cli
