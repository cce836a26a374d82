// SPDX-License-Identifier: Apache-2.0
// The memory budget, on the whole process.
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "tests/support/toy_run.h"

extern char** environ;

namespace {

struct Ended {
  int code = -1;
  double peak_mb = 0;
};

Ended run_command(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t child = 0;
  Ended ended;
  if (::posix_spawn(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) return ended;
  int status = 0;
  rusage usage{};
  if (::wait4(child, &status, 0, &usage) != child) return ended;
  ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  ended.peak_mb = static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
  return ended;
}

class MemoryBudget : public ::testing::TestWithParam<const char*> {};

// 3 GB of values pass through 500 MB; a sanitizer's own memory would count too.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double bar_mb = 1e9;
#else
constexpr double bar_mb = 600;
#endif

TEST_P(MemoryBudget, HoldsForThreeGigabytesOfValues) {
  const test::TemporaryFolder folder;
  const Ended ended = run_command(
      {FACEGRAPH_COMMAND, "run", std::string(FACEGRAPH_SOURCE_DIR) + "/graphs/toy/" + GetParam(), "--memory", "500MB",
       "--quiet", "--store", (folder.path() / "store").string(), "--out", (folder.path() / "out").string()});
  EXPECT_EQ(ended.code, 0);
  EXPECT_LE(ended.peak_mb, bar_mb);
  EXPECT_EQ(test::read_file(folder.path() / "out/bytes.txt"), "6000000000");
}

INSTANTIATE_TEST_SUITE_P(Graphs, MemoryBudget,
                         ::testing::Values("pressure.json", "pressure_cheap.json", "pressure_film.json"));

}  // namespace
