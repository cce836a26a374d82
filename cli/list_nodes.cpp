// SPDX-License-Identifier: Apache-2.0
// facegraph_list_nodes PLUGIN.so LIST.json: writes the plugin's node list.
#include <cstdio>
#include <fstream>

#include "engine/plugin/plugins.h"

int main(int count, char** words) {
  if (count != 3) {
    std::fprintf(stderr, "usage: facegraph_list_nodes PLUGIN.so LIST.json\n");
    return 2;
  }
  try {
    std::ofstream out(words[2], std::ios::binary);
    out << engine::write_node_list(engine::list_plugin(words[1]));
    out.close();
    return out ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
