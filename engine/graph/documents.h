// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/graph/json_tree.h"

namespace engine {

// A graph file with what it extends merged in.
struct GraphFile {
  SourceFile source;
  std::string path;     // absolute, normalised
  JsonValue tree;       // an object
  bool usable = false;  // false: it could not be read, which is among the problems
};

// Reads graph files, each once. Files and their values live as long as this object.
class Documents {
 public:
  explicit Documents(std::vector<Problem>& problems) : problems_(problems) {}

  // path: absolute. shown: what messages call it. asked_at: what named the file (the command line has no place).
  const GraphFile& read(const std::string& path, const std::string& shown, const Place& asked_at);

 private:
  const GraphFile& read_extended(const std::string& path, const std::string& shown, const Place& asked_at,
                                 std::vector<std::string>& chain);
  bool read_tree(GraphFile& file, const Place& asked_at);
  bool check_version(const GraphFile& file);

  std::vector<Problem>& problems_;
  std::map<std::string, std::unique_ptr<GraphFile>> files_;
};

// The path that a text of this source means: absolute, and as messages show it.
std::string resolve_path(const SourceFile& source, const std::string& path);
std::string shown_path(const SourceFile& source, const std::string& path);

}  // namespace engine
