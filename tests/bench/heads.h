// SPDX-License-Identifier: Apache-2.0
// The two heads of the benchmarks: embedded = 0, ICT = 1.
#pragma once
#include <benchmark/benchmark.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "nodes/decode/read_rig.h"
#include "nodes/phantom/make_head.h"
#include "tests/bench/material.h"

namespace bench {

// Empty, with the benchmark skipped, where the real material is absent.
inline std::optional<face::Rig> head(benchmark::State& state) {
  if (state.range(0) == 0) return face::phantom::make_head();
  const std::filesystem::path folder = ict_folder();
  if (!std::filesystem::exists(folder)) {
    state.SkipWithError("needs the ICT-FaceKit folder of the real material");
    return {};
  }
  std::vector<engine::File::Entry> entries;
  for (const auto& file : std::filesystem::recursive_directory_iterator(folder))
    if (file.is_regular_file())
      entries.push_back({std::filesystem::relative(file.path(), folder).generic_string(), file.path().string()});
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return face::decode::read_rig(engine::File::folder(folder.string(), entries), nullptr);
}

}  // namespace bench
