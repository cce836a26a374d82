// SPDX-License-Identifier: Apache-2.0
// The project's source tree as tests of its rules see it: files, lines, includes.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace test {

namespace fs = std::filesystem;

// "nodes/track/settle.cpp"
inline std::string text_of(const std::string& file) {
  std::ifstream in(fs::path(FACEGRAPH_SOURCE_DIR) / file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Every file below a folder of the tree whose name has one of the endings, sorted, as paths from the project's root.
inline std::vector<std::string> files_below(const std::string& folder, const std::vector<std::string>& endings) {
  std::vector<std::string> files;
  const fs::path root = FACEGRAPH_SOURCE_DIR;
  if (!fs::exists(root / folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string name = fs::relative(entry.path(), root).generic_string();
    if (entry.is_regular_file() &&
        std::any_of(endings.begin(), endings.end(), [&](const std::string& ending) { return name.ends_with(ending); }))
      files.push_back(name);
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline std::vector<std::string> sources_below(const std::string& folder) { return files_below(folder, {".h", ".cpp"}); }

// Every text file that the project keeps, in its own folders and at the root.
inline std::vector<std::string> kept_files(const std::vector<std::string>& endings) {
  std::vector<std::string> files;
  for (const char* folder : {".ci", "cli", "cmake", "docs", "engine", "graphs", "nodes", "plugins", "tests", "tools"}) {
    const std::vector<std::string> found = files_below(folder, endings);
    files.insert(files.end(), found.begin(), found.end());
  }
  for (const auto& entry : fs::directory_iterator(FACEGRAPH_SOURCE_DIR)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() &&
        std::any_of(endings.begin(), endings.end(), [&](const std::string& ending) { return name.ends_with(ending); }))
      files.push_back(name);
  }
  return files;
}

struct Include {
  std::string file;  // "engine/port.h", "vector"
  bool angled = false;
  std::string place;  // "nodes/track/settle.cpp:7"
};

inline std::vector<Include> includes_of(const std::string& file) {
  std::vector<Include> includes;
  const std::vector<std::string> lines = lines_of(text_of(file));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::string line = lines[i];
    line.erase(0, line.find_first_not_of(" \t"));
    if (!line.starts_with("#") || line.find("include") == std::string::npos) continue;
    const std::size_t open = line.find_first_of("<\"");
    if (open == std::string::npos) continue;
    const std::size_t close = line.find_first_of(">\"", open + 1);
    if (close == std::string::npos) continue;
    includes.push_back(
        {line.substr(open + 1, close - open - 1), line[open] == '<', file + ":" + std::to_string(i + 1)});
  }
  return includes;
}

// "nodes/track/settle.cpp" -> "track"
inline std::string second_folder(const std::string& file) {
  const std::size_t first = file.find('/');
  const std::size_t second = file.find('/', first + 1);
  return second == std::string::npos ? std::string() : file.substr(first + 1, second - first - 1);
}

inline bool is_adapter(const std::string& file) { return file.ends_with(".node.cpp") || file.ends_with(".type.cpp"); }

// The headers of the C++20 standard library and of C's.
inline bool is_standard(const std::string& header) {
  static const std::set<std::string> names = {"algorithm",
                                              "any",
                                              "array",
                                              "atomic",
                                              "barrier",
                                              "bit",
                                              "bitset",
                                              "cassert",
                                              "cctype",
                                              "cerrno",
                                              "cfenv",
                                              "cfloat",
                                              "charconv",
                                              "chrono",
                                              "cinttypes",
                                              "climits",
                                              "clocale",
                                              "cmath",
                                              "compare",
                                              "complex",
                                              "concepts",
                                              "condition_variable",
                                              "coroutine",
                                              "csetjmp",
                                              "csignal",
                                              "cstdarg",
                                              "cstddef",
                                              "cstdint",
                                              "cstdio",
                                              "cstdlib",
                                              "cstring",
                                              "ctime",
                                              "deque",
                                              "exception",
                                              "execution",
                                              "filesystem",
                                              "forward_list",
                                              "fstream",
                                              "functional",
                                              "future",
                                              "initializer_list",
                                              "iomanip",
                                              "ios",
                                              "iosfwd",
                                              "iostream",
                                              "istream",
                                              "iterator",
                                              "latch",
                                              "limits",
                                              "list",
                                              "locale",
                                              "map",
                                              "memory",
                                              "memory_resource",
                                              "mutex",
                                              "new",
                                              "numbers",
                                              "numeric",
                                              "optional",
                                              "ostream",
                                              "queue",
                                              "random",
                                              "ranges",
                                              "ratio",
                                              "regex",
                                              "scoped_allocator",
                                              "semaphore",
                                              "set",
                                              "shared_mutex",
                                              "span",
                                              "sstream",
                                              "stack",
                                              "stdexcept",
                                              "stop_token",
                                              "streambuf",
                                              "string",
                                              "string_view",
                                              "system_error",
                                              "thread",
                                              "tuple",
                                              "type_traits",
                                              "typeindex",
                                              "typeinfo",
                                              "unordered_map",
                                              "unordered_set",
                                              "utility",
                                              "valarray",
                                              "variant",
                                              "vector",
                                              "version"};
  return names.count(header) > 0;
}

}  // namespace test
