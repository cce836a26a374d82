// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/port.h"

namespace test {

// A folder and all below it as nodes get it.
inline engine::File folder_at(const std::string& path) {
  std::vector<engine::File::Entry> entries;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
    if (entry.is_regular_file())
      entries.push_back({std::filesystem::relative(entry.path(), path).string(), entry.path().string()});
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return engine::File::folder(path, std::move(entries));
}

}  // namespace test
