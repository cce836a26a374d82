// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "cli/pace.h"
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
  Pace pace_;
  bool quiet_;
  bool terminal_;
  double last_s_ = -1;
  bool drawn_ = false;
};

}  // namespace cli
