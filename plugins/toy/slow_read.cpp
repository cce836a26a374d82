// SPDX-License-Identifier: Apache-2.0
#include "plugins/toy/slow_read.h"

#include <chrono>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

namespace toy {

std::string slow_read(const engine::File& file, const SlowReadOptions& options, engine::Progress& progress) {
  std::ifstream in(file.path(), std::ios::binary | std::ios::ate);
  if (!in || file.is_folder()) throw std::runtime_error(file.name() + " is no file that can be read");
  std::string text(static_cast<std::size_t>(in.tellg()) / 2, '\0');
  in.seekg(0);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  constexpr double step_s = 0.01;
  for (double waited_s = 0; waited_s < options.seconds && !progress.stop_requested(); waited_s += step_s)
    std::this_thread::sleep_for(std::chrono::duration<double>(step_s));
  text.append(std::istreambuf_iterator<char>(in), {});
  return text;
}

}  // namespace toy
