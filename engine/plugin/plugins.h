// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/digest.h"
#include "engine/base/problem.h"
#include "engine/declare/call.h"
#include "engine/declare/node_info_json.h"

namespace engine {

// The plugins found in the declared folders. Listing reads the node list beside each library; a library without one, or
// with an older one, is first loaded in a process of its own, which writes it. A library is loaded here when a task
// first needs its code, and kept for the life of the process. Safe for several threads.
class Plugins {
 public:
  // Folders are searched in order; a plugin whose name was seen before is ignored. Where two plugins declare one node,
  // or lay one type out differently, that of the later folder stays: installed plugins come last. lister: the program
  // that loads a library for the first time, `lister LIBRARY LIST`; empty = facegraph_list_nodes beside the running
  // program.
  explicit Plugins(std::vector<std::string> folders, std::string lister = {});
  ~Plugins();

  // Of every plugin and of the engine itself; null where there is none.
  const NodeInfo* find(std::string_view node) const;
  std::vector<std::string> node_names() const;
  // The plugin of a node ("toy"); empty for the engine's own.
  std::string plugin_of(std::string_view node) const;
  std::vector<std::string> plugin_names() const;
  const std::map<std::string, TypeSummary, std::less<>>& types() const { return types_; }

  // A node with its code; loads its library. Throws PluginError with a one-line diagnosis.
  const NodeDeclaration& load(std::string_view node);
  // The declared type of a name; loads a library that has it. Null where there is none.
  const TypeInfo* load_type(std::string_view type);

  // The digest of a node's plugin (ARCHITECTURE section 5), computed once. Empty for the engine's own nodes.
  Digest digest(std::string_view node);

  // Why plugins are not used, as far as listing shows it: the library and a sentence each. Good plugins stay usable.
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  struct Library;
  void list(const std::string& path);
  void load(Library& library);

  std::string lister_;
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<Library>> libraries_;
  std::map<std::string, std::pair<const NodeInfo*, Library*>, std::less<>> nodes_;
  std::map<std::string, TypeSummary, std::less<>> types_;
  std::map<std::string, Library*, std::less<>> type_library_;
  std::vector<Problem> problems_;
};

// The node list of one library, by loading it. Throws PluginError.
NodeList list_plugin(const std::string& path);

// Loads a library's nodes after its tags were checked in the file. Throws PluginError.
std::vector<NodeDeclaration> load_plugin(const std::string& path);

}  // namespace engine
