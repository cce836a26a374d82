// SPDX-License-Identifier: Apache-2.0
#include "cli/context.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace cli {
namespace fs = std::filesystem;

std::vector<std::string> plugin_folders(const Common& common) {
  std::vector<std::string> folders = common.plugin_folders;
  for (const std::string& folder : folders)
    if (!fs::is_directory(folder))
      throw std::invalid_argument("command line: --plugins " + folder + ": there is no such folder");
  if (const char* set = std::getenv("FACEGRAPH_PLUGINS"))
    for (std::string rest = set; !rest.empty();) {
      const std::size_t colon = std::min(rest.find(':'), rest.size());
      if (colon > 0) folders.push_back(rest.substr(0, colon));
      rest.erase(0, colon + 1);
    }
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  folders.push_back((self.parent_path().parent_path() / "lib" / "facegraph" / "plugins").string());
  return folders;
}

std::unique_ptr<engine::Plugins> open_plugins(const Common& common) {
  auto plugins = std::make_unique<engine::Plugins>(plugin_folders(common));
  for (const engine::Problem& problem : plugins->problems())
    std::fprintf(stderr, "warning: plugin %s cannot be used: %s\n", problem.place.file.c_str(), problem.text.c_str());
  return plugins;
}

std::shared_ptr<engine::Store> open_store(const Common& common) {
  std::string folder = common.store;
  if (folder.empty())
    if (const char* set = std::getenv("FACEGRAPH_STORE")) folder = set;
  if (folder.empty()) {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"))
      folder = std::string(cache) + "/facegraph";
    else if (const char* home = std::getenv("HOME"))
      folder = std::string(home) + "/.cache/facegraph";
    else
      throw engine::EngineError("there is no place for the store: set FACEGRAPH_STORE, or give --store FOLDER");
  }
  return engine::Store::open(fs::absolute(folder).string());
}

engine::GraphReading read_graph(const std::string& path, const std::vector<engine::Setting>& settings,
                                const engine::Plugins& plugins) {
  engine::GraphContext context;
  context.find_node = [&](std::string_view name) { return plugins.find(name); };
  context.node_names = [&] { return plugins.node_names(); };
  context.absent_plugin = [&](std::string_view name) -> std::string {
    for (const engine::Problem& problem : plugins.problems())
      if (fs::path(problem.place.file).stem().string() == name.substr(0, name.find('.')))
        return "its plugin cannot be used: " + problem.text;
    return {};
  };
  return engine::read_graph(path, settings, fs::current_path().string(), context);
}

bool read_graph(const GraphArguments& arguments, const engine::Plugins& plugins, engine::Graph& graph) {
  std::vector<engine::Setting> settings;
  for (const std::string& set : arguments.sets) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos) {
      std::fprintf(stderr, "command line: --set %s: expected NAME=VALUE\n", set.c_str());
      return false;
    }
    settings.push_back({set.substr(0, equals), set.substr(equals + 1)});
  }
  engine::GraphReading reading = read_graph(arguments.path, settings, plugins);
  for (const engine::Problem& problem : reading.problems) std::fprintf(stderr, "%s\n", problem.line().c_str());
  if (!reading.problems.empty()) {
    std::fprintf(stderr, "%zu problem%s; nothing was run\n", reading.problems.size(),
                 reading.problems.size() == 1 ? "" : "s");
    return false;
  }
  graph = std::move(reading.graph);
  for (const std::string& note : graph.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  return true;
}

bool read_reference(const std::string& text, engine::Reference& reference) {
  std::string error;
  if (engine::parse_reference(text, reference, error)) return true;
  std::fprintf(stderr, "command line: %s\n", error.c_str());
  return false;
}

}  // namespace cli
