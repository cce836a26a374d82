// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace toy {

struct UnsteadyOptions {
  bool unsteady = true;
};
// The text, with the time of day behind it if `unsteady`: what a node must never do. `facegraph cache audit` finds it.
std::string unsteady(const std::string& text, const UnsteadyOptions& options);

}  // namespace toy
