// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace test {

// The folder of real material: FACEGRAPH_DATA, else ../shared/data seen from the project's root.
inline std::filesystem::path data_folder() {
  if (const char* set = std::getenv("FACEGRAPH_DATA")) return set;
  return std::filesystem::path(FACEGRAPH_SOURCE_DIR) / ".." / "shared" / "data";
}

}  // namespace test

// Skips the test, saying why, where a file of the real material is absent; else the variable holds its path.
#define DATA_FILE(variable, relative)                                       \
  const std::string variable = (test::data_folder() / (relative)).string(); \
  if (!std::filesystem::exists(variable))                                   \
  GTEST_SKIP() << "needs " << (relative) << " of the real material (set FACEGRAPH_DATA to its folder)"
