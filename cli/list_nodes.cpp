// SPDX-License-Identifier: Apache-2.0
// facegraph_list_nodes PLUGIN.so LIST.json: writes the plugin's node list. Run when a plugin is built, and by the
// command for a plugin that has no list: whatever the library does while it is loaded, it does it here.
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>

#include "engine/plugin/plugins.h"

namespace {

const char* plugin_path = "";

// What an initialiser throws reaches nobody who could catch it: the loader lets nothing through.
[[noreturn]] void tell_what_was_thrown() {
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    std::abort();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plugin %s cannot be used: an initialiser throws: %s\n", plugin_path, error.what());
  } catch (...) {
    std::fprintf(stderr, "plugin %s cannot be used: an initialiser throws what is no std::exception\n", plugin_path);
  }
  std::_Exit(3);
}

int list(const char* plugin, const char* file) {
  try {
    const std::string text = engine::write_node_list(engine::list_plugin(plugin));
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (out) return 0;
    std::fprintf(stderr, "cannot write %s\n", file);
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::fprintf(stderr, "usage: facegraph_list_nodes PLUGIN.so LIST.json\n");
    return 2;
  }
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  plugin_path = words[1];
  std::set_terminate(&tell_what_was_thrown);
  // Without the library's finalisers, which may hang after a load that failed.
  std::_Exit(list(words[1], words[2]));
}
