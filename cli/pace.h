// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <string>

#include "engine/run/run.h"

namespace cli {

// "flow", or "flow[17]" of an element.
std::string task_name(const engine::RunEvent& event);

// How far a run is, from its events.
class Pace {
 public:
  void see(const engine::RunEvent& event);
  // "film 37 %": the running task that says how far it is and has most to do; else the event's task.
  std::string task(const engine::RunEvent& event) const;
  // "40 s left", "12 min left", or empty where nothing tells. Tasks that wait are taken to last as long as those that
  // were done, a running one as long as its own share of the work says.
  std::string left(const engine::RunEvent& event) const;

 private:
  struct Running {
    double since_s = 0;
    double fraction = 0;
  };
  // Seconds that a running task still needs; < 0 where it has said too little.
  static double rest_s(const Running& running, double now_s);
  std::map<std::string, Running> running_;
  std::size_t reused_ = 0;  // tasks that took no time
};

}  // namespace cli
