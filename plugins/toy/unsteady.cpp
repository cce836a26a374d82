// SPDX-License-Identifier: Apache-2.0
#include "plugins/toy/unsteady.h"

#include <chrono>

namespace toy {

std::string unsteady(const std::string& text, const UnsteadyOptions& options) {
  if (!options.unsteady) return text;
  return text + std::to_string(std::chrono::steady_clock::now().time_since_epoch().count());
}

}  // namespace toy
