// SPDX-License-Identifier: Apache-2.0
#include <malloc.h>

#include <cstdio>
#include <stdexcept>

#include "cli/command_line.h"

namespace {

int failed(const std::exception& error, cli::Exit code) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return code;
}

}  // namespace

int main(int count, char** words) {
  // Large values come and go: their memory shall go back to the system.
  ::mallopt(M_MMAP_THRESHOLD, 1 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
  try {
    return cli::run_command_line(count, words);
  } catch (const engine::PluginError& error) {
    return failed(error, cli::plugin_problem);
  } catch (const std::invalid_argument& error) {
    return failed(error, cli::invalid);
  } catch (const std::exception& error) {
    return failed(error, cli::task_failed);
  }
}
