// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/port.h"

namespace toy {

struct SlowReadOptions {
  double seconds = 1;
};
// The bytes of a file, as text: half of them at once, the rest after a while.
std::string slow_read(const engine::File& file, const SlowReadOptions& options, engine::Progress& progress);

}  // namespace toy
