// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace engine {

// Where something stands in a graph file (or on the command line: file = "command line", no line).
struct Place {
  std::string file;
  int line = 0;         // from 1; 0 where there is none
  int column = 0;       // from 1
  std::string pointer;  // JSON pointer: /nodes/flow/params/levels
};

// One thing that is wrong with a graph, its arguments or a plugin.
struct Problem {
  Place place;
  std::string text;  // what was found, what was expected

  // "talk.json:12:5: /nodes/flow/params/levels: found 99, expected 1 to 10"
  std::string line() const;
};

// A plugin cannot be used; exit code 3.
class PluginError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A failure of the engine's surroundings (a full disk, an unreadable folder) that a person must see to.
class EngineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The candidate nearest to a misspelt name (edit distance at most a third of its length), or empty.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

// " (did you mean 'levels'?)", or empty.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

// "'a', 'b' and 'c'"
std::string listed(const std::vector<std::string>& names, const char* last = "and");

// Takes the place of did_you_mean() where names are few: the nearest one, else all there are: "; it has 'a' and 'b'".
std::string did_you_mean_of(std::string_view name, const std::vector<std::string>& names);

}  // namespace engine
