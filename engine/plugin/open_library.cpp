// SPDX-License-Identifier: Apache-2.0
#include "engine/plugin/open_library.h"

#include <cxxabi.h>
#include <dlfcn.h>

#include <boost/dll/shared_library.hpp>
#include <boost/dll/shared_library_load_mode.hpp>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "engine/plugin/descriptor.h"
#include "engine/plugin/library_digest.h"

namespace engine {
namespace {

constexpr const char* no_descriptor = "it has no Facegraph descriptor";

// Values keep pointers into the libraries of their types: a library stays to the end of the process.
constexpr auto load_for_good = boost::dll::load_mode::rtld_now | static_cast<boost::dll::load_mode::type>(RTLD_NODELETE);

std::string bounded(const char* text, std::size_t size) { return {text, strnlen(text, size)}; }

// Why a library's tags forbid loading it; empty when they agree.
std::string disagreement(const PluginTags& tags) {
  if (tags.abi != this_abi.abi)
    return "it was built for plugin ABI " + std::to_string(tags.abi) + ", this engine has " +
           std::to_string(this_abi.abi) + (tags.abi < this_abi.abi ? ": rebuild the plugin" : ": update the engine");
  const auto differ = [](const char* what, const char* found, const char* expected, std::size_t size) -> std::string {
    if (bounded(found, size) == bounded(expected, size)) return {};
    return std::string("it was built with ") + what + " '" + bounded(found, size) + "', expected '" +
           bounded(expected, size) + "'";
  };
  std::string text = differ("compiler", tags.compiler, this_abi.compiler, sizeof tags.compiler);
  if (text.empty())
    text = differ("standard library", tags.standard_library, this_abi.standard_library, sizeof tags.standard_library);
  if (text.empty()) text = differ("flags", tags.flags, this_abi.flags, sizeof tags.flags);
  return text;
}

std::string readable(const std::string& symbol) {
  int status = -1;
  const std::unique_ptr<char, void (*)(void*)> text(abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status),
                                                    &std::free);
  return status == 0 ? std::string(text.get()) : symbol;
}

// The loader's words as a reason. Boost wraps them as "... (dlerror system message: WORDS): ...".
std::string loader_reason(std::string text, const std::string& path) {
  const std::string start = "dlerror system message: ";
  if (const std::size_t at = text.find(start); at != std::string::npos) {
    text.erase(0, at + start.size());
    text.erase(std::min(text.rfind("): "), text.size()));
  }
  if (text.starts_with(path + ": ")) text.erase(0, path.size() + 2);
  const std::string undefined = "undefined symbol: ";
  if (text.starts_with(undefined)) {
    const std::string symbol =
        text.substr(undefined.size(), text.find_first_of(", \t", undefined.size()) - undefined.size());
    return "no library has the symbol that it needs: " + readable(symbol);
  }
  const std::string missing = ": cannot open shared object file: ";
  if (const std::size_t at = text.find(missing); at != std::string::npos)
    return "it needs " + text.substr(0, at) + ", which cannot be opened: " + text.substr(at + missing.size());
  return "the loader says: " + text;
}

}  // namespace

std::string unusable(const std::string& path) { return "plugin " + path + " cannot be used: "; }

void check_tags(const std::string& path) {
  std::string section;
  try {
    section = read_section(path, plugin_tags_section);
  } catch (const std::exception& error) {
    std::string text = error.what();
    if (text.starts_with(path + " is no usable shared library: ")) text = "it" + text.substr(path.size());
    throw std::runtime_error(text);
  }
  PluginTags tags;
  if (section.size() < sizeof tags) throw std::runtime_error(no_descriptor);
  std::memcpy(&tags, section.data(), sizeof tags);
  if (std::memcmp(tags.magic, plugin_magic, sizeof tags.magic) != 0) throw std::runtime_error(no_descriptor);
  const std::string text = disagreement(tags);
  if (!text.empty()) throw std::runtime_error(text);
}

std::vector<NodeDeclaration> open_library(const std::string& path) {
  check_tags(path);
  std::vector<NodeDeclaration> nodes;
  try {
    boost::dll::shared_library library(path, load_for_good);
    if (!library.has(plugin_entry_symbol)) throw std::runtime_error(no_descriptor);
    nodes = library.get<const PluginDescriptor>(plugin_entry_symbol).nodes();
  } catch (const boost::system::system_error& error) {
    throw std::runtime_error(loader_reason(error.what(), path));
  }
  std::set<std::string> names;
  for (const NodeDeclaration& node : nodes)
    if (!names.insert(node.info.name).second) throw std::runtime_error("it declares node " + node.info.name + " twice");
  return nodes;
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
    TypeSummary summary{name, type->codec_version, type->doc, type->layout, {}, type->difference};
    for (const TypeInfo::View& view : type->views) summary.views.emplace_back(view.suffix, view.node);
    list.types.push_back(std::move(summary));
  }
  return list;
}

}  // namespace engine
