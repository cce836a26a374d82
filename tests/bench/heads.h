// SPDX-License-Identifier: Apache-2.0
// The two heads of the benchmarks: embedded = 0, ICT = 1.
#pragma once
#include <benchmark/benchmark.h>

#include <optional>
#include <string>
#include <vector>

#include "nodes/decode/read_rig.h"
#include "nodes/phantom/make_head.h"
#include "tests/bench/material.h"
#include "tests/support/folder_file.h"

namespace bench {

// Empty, with the benchmark skipped, where the real material is absent.
inline std::optional<face::Rig> head(benchmark::State& state) {
  if (state.range(0) == 0) return face::phantom::make_head();
  const std::filesystem::path folder = ict_folder();
  if (!std::filesystem::exists(folder)) {
    state.SkipWithError("needs the ICT-FaceKit folder of the real material");
    return {};
  }
  return face::decode::read_rig(test::folder_file(folder), nullptr);
}

}  // namespace bench
