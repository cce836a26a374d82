// SPDX-License-Identifier: Apache-2.0
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "cli/commands.h"
#include "engine/describe/view.h"
#include "engine/run/run.h"

namespace cli {

int get(const Common& common, const GetArguments& arguments) {
  const auto plugins = open_plugins(common);
  engine::Graph graph;
  if (!read_graph(arguments.graph, *plugins, graph)) return invalid;
  engine::Reference reference;
  if (!read_reference(arguments.reference, reference)) return invalid;
  const auto store = open_store(common);
  const engine::GotValue got = engine::get_value(graph, *plugins, *store, reference, {});
  if (arguments.out.empty()) {
    std::printf("%s\n", got.value.type().show(got.value.data().get()).c_str());
    return done;
  }
  const std::string bytes =
      engine::view_value(got.value, std::filesystem::path(arguments.out).extension().string(), *plugins);
  std::FILE* file = std::fopen(arguments.out.c_str(), "wbe");
  const bool written = file && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  if (!file || std::fclose(file) != 0 || !written) {
    std::fprintf(stderr, "error: cannot write %s: %s\n", arguments.out.c_str(), std::strerror(errno));
    return task_failed;
  }
  return done;
}

}  // namespace cli
