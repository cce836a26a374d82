// SPDX-License-Identifier: Apache-2.0
#include "engine/plugin/plugins.h"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include "engine/plugin/first_load.h"
#include "engine/plugin/library_digest.h"
#include "engine/plugin/open_library.h"

namespace engine {
namespace fs = std::filesystem;
namespace {

fs::path list_beside(const std::string& path) { return fs::path(path).replace_extension(".nodes.json"); }

// The node list beside a library, unless it is absent, older than the library or damaged.
std::optional<NodeList> read_list_beside(const std::string& path) {
  std::error_code error;
  const auto written = fs::last_write_time(list_beside(path), error);
  if (error || written < fs::last_write_time(path, error) || error) return std::nullopt;
  std::ifstream in(list_beside(path), std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  try {
    return read_node_list(text.str());
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

// Where the folder is writable. The list is as old as the library that it was made from, should that change meanwhile.
void write_list_beside(const std::string& path, const NodeList& list, fs::file_time_type library_time) {
  const fs::path final_path = list_beside(path);
  const fs::path unfinished = final_path.string() + "." + std::to_string(::getpid());
  std::error_code error;
  {
    std::ofstream out(unfinished, std::ios::binary);
    out << write_node_list(list);
    out.close();
    if (!out) error = std::make_error_code(std::errc::io_error);
  }
  if (!error) fs::last_write_time(unfinished, library_time, error);
  if (!error) fs::rename(unfinished, final_path, error);
  if (error) fs::remove(unfinished, error);
}

// The folder of the engine's own library, where the value types' library lies too.
std::string engine_folder() {
  Dl_info info;
  if (::dladdr(reinterpret_cast<const void*>(&structural_nodes), &info) == 0) return {};
  return fs::path(info.dli_fname).parent_path().string();
}

}  // namespace

struct Plugins::Library {
  std::string name, path;
  NodeList list;
  bool loaded = false;
  std::vector<NodeDeclaration> nodes;
  Digest digest;
};

std::vector<NodeDeclaration> load_plugin(const std::string& path) {
  try {
    return open_library(path);
  } catch (const std::exception& error) {
    throw PluginError(unusable(path) + error.what());
  }
}

NodeList list_plugin(const std::string& path) { return list_of(load_plugin(path)); }

Plugins::Plugins(std::vector<std::string> folders, std::string lister)
    : lister_(lister.empty() ? lister_beside_this_program() : std::move(lister)) {
  for (const NodeInfo& node : structural_nodes()) nodes_[node.name] = {&node, nullptr};
  std::vector<std::vector<std::string>> found;
  std::set<std::string> names;
  for (const std::string& folder : folders) {
    std::vector<std::string> paths;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
      if (at->path().extension() == ".so" && names.insert(at->path().stem().string()).second)
        paths.push_back(at->path().string());
    std::sort(paths.begin(), paths.end());
    found.push_back(std::move(paths));
  }
  // From the last folder, so that a stranger's plugin never pushes an installed one aside.
  for (auto paths = found.rbegin(); paths != found.rend(); ++paths)
    for (const std::string& path : *paths) list(path);
}

Plugins::~Plugins() = default;

void Plugins::list(const std::string& path) {
  auto library = std::make_unique<Library>();
  library->path = path;
  library->name = fs::path(path).stem().string();
  const auto refuse = [&](const std::string& reason) {
    Problem problem;
    problem.place.file = path;
    problem.text = reason;
    problems_.push_back(std::move(problem));
  };
  if (std::optional<NodeList> list = read_list_beside(path)) {
    library->list = std::move(*list);
  } else {
    try {
      check_tags(path);
      std::error_code error;
      const auto time = fs::last_write_time(path, error);
      library->list = first_load(path, lister_);
      if (!error) write_list_beside(path, library->list, time);
    } catch (const std::exception& error) {
      return refuse(error.what());
    }
  }
  for (const NodeInfo& node : library->list.nodes) {
    const auto known = nodes_.find(node.name);
    if (known != nodes_.end())
      return refuse("its node " + node.name + " is already declared by " +
                    (known->second.second ? "plugin " + known->second.second->path : std::string("the engine")));
  }
  for (const TypeSummary& type : library->list.types) {
    const auto known = types_.find(type.name);
    if (known != types_.end() &&
        (known->second.layout != type.layout || known->second.codec_version != type.codec_version))
      return refuse("its type " + type.name + " is laid out differently in plugin " + type_library_[type.name]->path);
  }
  for (const NodeInfo& node : library->list.nodes) nodes_[node.name] = {&node, library.get()};
  for (const TypeSummary& type : library->list.types)
    if (types_.emplace(type.name, type).second) type_library_[type.name] = library.get();
  libraries_.push_back(std::move(library));
}

void Plugins::load(Library& library) {
  if (library.loaded) return;
  library.nodes = load_plugin(library.path);
  if (write_node_list(list_of(library.nodes)) != write_node_list(library.list))
    throw PluginError(unusable(library.path) + "its node list was written for another library: delete " +
                      list_beside(library.path).string());
  library.loaded = true;
}

const NodeInfo* Plugins::find(std::string_view node) const {
  const auto at = nodes_.find(node);
  return at == nodes_.end() ? nullptr : at->second.first;
}

std::vector<std::string> Plugins::node_names() const {
  std::vector<std::string> names;
  for (const auto& [name, entry] : nodes_) names.push_back(name);
  return names;
}

std::string Plugins::plugin_of(std::string_view node) const {
  const auto at = nodes_.find(node);
  return at == nodes_.end() || !at->second.second ? std::string() : at->second.second->name;
}

std::vector<std::string> Plugins::plugin_names() const {
  std::vector<std::string> names;
  for (const auto& library : libraries_) names.push_back(library->name);
  return names;
}

const NodeDeclaration& Plugins::load(std::string_view node) {
  const std::lock_guard lock(mutex_);
  const auto at = nodes_.find(node);
  if (at == nodes_.end() || !at->second.second) throw PluginError("no plugin has a node " + std::string(node));
  Library& library = *at->second.second;
  load(library);
  for (const NodeDeclaration& declaration : library.nodes)
    if (declaration.info.name == node) return declaration;
  throw PluginError("plugin " + library.path + " has no node " + std::string(node));
}

const TypeInfo* Plugins::load_type(std::string_view type) {
  const std::lock_guard lock(mutex_);
  const auto at = type_library_.find(type);
  if (at == type_library_.end()) return nullptr;
  load(*at->second);
  for (const NodeDeclaration& node : at->second->nodes) {
    for (const TypeInfo* info : node.input_types)
      if (info->name == type) return info;
    for (const TypeInfo* info : node.output_types)
      if (info->name == type) return info;
  }
  return nullptr;
}

Digest Plugins::digest(std::string_view node) {
  const std::lock_guard lock(mutex_);
  const auto at = nodes_.find(node);
  if (at == nodes_.end() || !at->second.second) return {};
  Library& library = *at->second.second;
  if (library.digest.empty())
    library.digest = library_digest(library.path, {fs::path(library.path).parent_path().string(), engine_folder()});
  return library.digest;
}

}  // namespace engine
