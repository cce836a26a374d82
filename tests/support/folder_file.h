// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/port.h"

namespace test {

// A folder of the disk as a node would be given it.
inline engine::File folder_file(const std::filesystem::path& folder) {
  std::vector<engine::File::Entry> entries;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      entries.push_back({std::filesystem::relative(entry.path(), folder).generic_string(), entry.path().string()});
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return engine::File::folder(folder.string(), entries);
}

}  // namespace test
