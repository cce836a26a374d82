// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <map>
#include <string>

#include "cli/pace.h"
#include "engine/run/run.h"

namespace cli {

// Shows a run: a bar with the time left on a terminal, plain lines elsewhere. What many elements of a node fail with or
// warn of alike is told of the first few and counted.
class ProgressPrinter {
 public:
  explicit ProgressPrinter(bool quiet);
  void show(const engine::RunEvent& event);
  void clear();
  // After the run: how many elements were not told of.
  void finish();

 private:
  void tell(const engine::RunEvent& event);
  void bar(const engine::RunEvent& event);
  Pace pace_;
  bool quiet_;
  bool terminal_;
  double last_s_ = -1;
  bool drawn_ = false;
  std::map<std::string, std::size_t> alike_;  // "failed: flow: what was said", and how often
};

}  // namespace cli
