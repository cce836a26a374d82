// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "cli/context.h"
#include "cli/experiments.h"

namespace cli {

// Does what was typed; returns the exit code. Prints what cannot be understood; what a command throws goes on.
int run_command_line(int count, const char* const* words);

// What could not be understood of a command line.
struct Mistyped {
  std::vector<std::string> commands;  // that could: "cache", "gc"
  std::vector<std::string> rest;      // words that could not
  std::string problem;                // where every word could
};
// Says it in a line, with the nearest word that could have been meant. tree: all that can be typed.
std::string what_is_wrong(const CommandTree& tree, const Mistyped& mistyped, const Common& common);

}  // namespace cli
