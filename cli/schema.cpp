// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cli/commands.h"
#include "engine/describe/describe.h"

namespace cli {

int schema(const Common& common) {
  const auto plugins = open_plugins(common);
  std::printf("%s\n", engine::graph_schema(*plugins).c_str());
  return done;
}

}  // namespace cli
