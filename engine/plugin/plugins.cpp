// SPDX-License-Identifier: Apache-2.0
#include "engine/plugin/plugins.h"

#include <boost/dll/shared_library.hpp>
#include <boost/dll/shared_library_load_mode.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/plugin/descriptor.h"
#include "engine/plugin/library_digest.h"

namespace engine {
namespace fs = std::filesystem;
namespace {

std::string bounded(const char* text, std::size_t size) { return {text, strnlen(text, size)}; }

// Why a library's tags forbid loading it; empty when they agree.
std::string disagreement(const PluginTags& tags) {
  if (tags.abi != this_abi.abi)
    return "it was built for plugin ABI " + std::to_string(tags.abi) + ", this engine has " + std::to_string(this_abi.abi) +
           (tags.abi < this_abi.abi ? ": rebuild the plugin" : ": update the engine");
  const auto differ = [](const char* what, const char* found, const char* expected, std::size_t size) -> std::string {
    if (bounded(found, size) == bounded(expected, size)) return {};
    return std::string("it was built with ") + what + " '" + bounded(found, size) + "', expected '" + bounded(expected, size) + "'";
  };
  std::string text = differ("compiler", tags.compiler, this_abi.compiler, sizeof tags.compiler);
  if (text.empty()) text = differ("standard library", tags.standard_library, this_abi.standard_library, sizeof tags.standard_library);
  if (text.empty()) text = differ("flags", tags.flags, this_abi.flags, sizeof tags.flags);
  return text;
}

void check_tags(const std::string& path) {
  std::string section;
  try {
    section = read_section(path, plugin_tags_section);
  } catch (const std::exception& error) {
    throw PluginError("plugin " + path + " cannot be used: " + error.what());
  }
  if (section.size() < sizeof(PluginTags))
    throw PluginError("plugin " + path + " cannot be used: it has no Facegraph descriptor");
  PluginTags tags;
  std::memcpy(&tags, section.data(), sizeof tags);
  if (std::memcmp(tags.magic, plugin_magic, sizeof tags.magic) != 0)
    throw PluginError("plugin " + path + " cannot be used: it has no Facegraph descriptor");
  const std::string text = disagreement(tags);
  if (!text.empty()) throw PluginError("plugin " + path + " cannot be used: " + text);
}

NodeList list_of(const std::vector<NodeDeclaration>& nodes) {
  NodeList list;
  std::map<std::string, const TypeInfo*> types;
  for (const NodeDeclaration& node : nodes) {
    list.nodes.push_back(node.info);
    for (const TypeInfo* type : node.input_types) types[type->name] = type;
    for (const TypeInfo* type : node.output_types) types[type->name] = type;
  }
  for (const auto& [name, type] : types) {
    TypeSummary summary{name, type->codec_version, type->doc, type->layout, {}};
    for (const TypeInfo::View& view : type->views) summary.views.emplace_back(view.suffix, view.node);
    list.types.push_back(std::move(summary));
  }
  return list;
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
  check_tags(path);
  try {
    // Never unloaded: values keep pointers into the library.
    auto* library = new boost::dll::shared_library(path, boost::dll::load_mode::rtld_now);
    if (!library->has(plugin_entry_symbol))
      throw PluginError("plugin " + path + " cannot be used: it has no symbol " + plugin_entry_symbol);
    return library->get<const PluginDescriptor>(plugin_entry_symbol).nodes();
  } catch (const boost::system::system_error& error) {
    std::string text = error.what();
    if (const std::size_t bracket = text.find('('); bracket != std::string::npos) text = text.substr(bracket);
    throw PluginError("plugin " + path + " cannot be loaded: " + text);
  } catch (const PluginError&) {
    throw;
  } catch (const std::exception& error) {
    throw PluginError("plugin " + path + " cannot be loaded: " + error.what());
  }
}

NodeList list_plugin(const std::string& path) { return list_of(load_plugin(path)); }

Plugins::Plugins(std::vector<std::string> folders) {
  for (const NodeInfo& node : structural_nodes()) nodes_[node.name] = {&node, nullptr};
  for (const std::string& folder : folders) {
    std::vector<std::string> paths;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
      if (at->path().extension() == ".so") paths.push_back(at->path().string());
    std::sort(paths.begin(), paths.end());
    for (const std::string& path : paths) list(path);
  }
}

Plugins::~Plugins() = default;

void Plugins::list(const std::string& path) {
  auto library = std::make_unique<Library>();
  library->path = path;
  library->name = fs::path(path).stem().string();
  for (const auto& known : libraries_)
    if (known->name == library->name) return;
  try {
    const fs::path sidecar = fs::path(path).replace_extension(".nodes.json");
    std::error_code error;
    if (fs::exists(sidecar, error) && fs::last_write_time(sidecar, error) >= fs::last_write_time(path, error)) {
      std::ifstream in(sidecar, std::ios::binary);
      std::ostringstream text;
      text << in.rdbuf();
      library->list = read_node_list(text.str());
    } else {
      load(*library);
    }
  } catch (const std::exception& error) {
    problems_.push_back({{path, 0, 0, ""}, error.what()});
    return;
  }
  for (const NodeInfo& node : library->list.nodes) {
    const auto known = nodes_.find(node.name);
    if (known != nodes_.end()) {
      const std::string other = known->second.second ? "plugin " + known->second.second->path : std::string("the engine");
      problems_.push_back({{path, 0, 0, ""}, "its node " + node.name + " is already declared by " + other + "; the plugin is not used"});
      return;
    }
  }
  for (const TypeSummary& type : library->list.types) {
    const auto known = types_.find(type.name);
    if (known != types_.end() && (known->second.layout != type.layout || known->second.codec_version != type.codec_version)) {
      problems_.push_back({{path, 0, 0, ""}, "its type '" + type.name + "' is laid out differently in plugin " +
                                                 type_library_[type.name]->path + "; the plugin is not used"});
      return;
    }
  }
  for (const NodeInfo& node : library->list.nodes) nodes_[node.name] = {&node, library.get()};
  for (const TypeSummary& type : library->list.types)
    if (types_.emplace(type.name, type).second) type_library_[type.name] = library.get();
  libraries_.push_back(std::move(library));
}

void Plugins::load(Library& library) {
  if (library.loaded) return;
  library.nodes = load_plugin(library.path);
  const NodeList list = list_of(library.nodes);
  if (!library.list.nodes.empty() && write_node_list(list) != write_node_list(library.list))
    throw PluginError("plugin " + library.path + " is not the one its node list was written for: rebuild it, or delete the list beside it");
  if (library.list.nodes.empty()) library.list = list;
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
    library.digest = library_digest(library.path, {fs::path(library.path).parent_path().string()});
  return library.digest;
}

}  // namespace engine
