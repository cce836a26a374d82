// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>

#include "cli/commands.h"
#include "cli/experiments.h"
#include "engine/base/problem.h"
#include "engine/describe/describe.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw engine::EngineError("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

// Folders of starter graphs, by name: whatever is installed.
std::vector<std::string> starters(const fs::path& graphs) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(graphs, error)) {
    if (!entry.is_directory()) continue;
    bool any = false;
    for (const auto& file : fs::directory_iterator(entry.path())) any |= file.path().extension() == ".json";
    if (any && entry.path().filename() != "broken") names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// The comment at the top of a graph, or its "doc".
std::string purpose_of(const std::string& text) {
  std::string purpose;
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1)) {
    std::size_t start = text.find_first_not_of(" ", at + 1);
    if (start == std::string::npos || text.compare(start, 2, "//") != 0) break;
    start += 2;
    const std::string line = text.substr(start, text.find('\n', start) - start);
    if (line.find("facegraph ") != std::string::npos) break;
    purpose += line;
  }
  purpose.erase(0, std::min(purpose.find_first_not_of(' '), purpose.size()));
  return purpose;
}

// The texts in quotes of a file that are paths of files or folders in the tree of graphs.
std::vector<fs::path> named_files(const fs::path& file, const fs::path& graphs) {
  std::vector<fs::path> found;
  const std::string text = content_of(file);
  for (std::size_t at = text.find('"'); at != std::string::npos;) {
    const std::size_t end = text.find('"', at + 1);
    if (end == std::string::npos) break;
    const std::string word = text.substr(at + 1, end - at - 1);
    at = text.find('"', end + 1);
    if (word.empty() || word.size() > 200 || word[0] == '/' || word.find('\n') != std::string::npos) continue;
    const fs::path path = (file.parent_path() / word).lexically_normal();
    const std::string inside = path.lexically_relative(graphs).string();
    if (inside == "." || inside.starts_with("..") || inside.find('/') == std::string::npos) continue;
    std::error_code error;
    if (fs::exists(path, error)) found.push_back(path);
  }
  return found;
}

std::string listed_names(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// The beginning of a name is enough where no other begins so.
std::string starter_meant(const std::string& from, const std::vector<std::string>& names) {
  std::vector<std::string> meant;
  for (const std::string& name : names) {
    if (name == from) return name;
    if (name.starts_with(from)) meant.push_back(name);
  }
  if (meant.size() == 1) return meant[0];
  throw std::invalid_argument("command line: --from " + from + ": expected one of " + listed_names(names) +
                              engine::did_you_mean(from, names));
}

// What a starter needs, and its place in a folder of its own: its own files come to the top; what they name elsewhere
// in the tree comes below it.
std::map<fs::path, fs::path> copies_of(const fs::path& from, const fs::path& graphs) {
  std::map<fs::path, fs::path> copies;
  std::vector<fs::path> open;
  const auto add = [&](const fs::path& path) {
    const fs::path inner = path.lexically_relative(from);
    const bool own = *inner.begin() != "..";
    if (copies.emplace(path, own ? inner : path.lexically_relative(graphs)).second) open.push_back(path);
  };
  for (const auto& entry : fs::directory_iterator(from)) add(entry.path());
  while (!open.empty()) {
    const fs::path path = open.back();
    open.pop_back();
    if (fs::is_directory(path)) {
      for (const auto& entry : fs::directory_iterator(path)) add(entry.path());
    } else if (path.extension() == ".json") {
      for (const fs::path& named : named_files(path, graphs)) add(named);
    }
  }
  return copies;
}

void replace_all(std::string& text, const std::string& was, const std::string& is) {
  if (was == is) return;
  for (std::size_t at = 0; (at = text.find(was, at)) != std::string::npos; at += is.size())
    text.replace(at, was.size(), is);
}

// A starter's file as it is copied: a graph names other files by their new places, and its comments, which say how it
// is run from the project's folder, how it is run from its own.
std::string text_to_copy(const fs::path& path, const std::map<fs::path, fs::path>& copies, const fs::path& from,
                         const fs::path& graphs) {
  std::string text = content_of(path);
  if (path.extension() != ".json" || path.parent_path() != from) return text;
  for (const fs::path& named : named_files(path, graphs))
    replace_all(text, "\"" + named.lexically_relative(from).string() + "\"", "\"" + copies.at(named).string() + "\"");
  replace_all(text, "graphs/" + from.filename().string() + "/", "");
  return text;
}

}  // namespace

int make_new(const Common& common, const NewArguments& arguments) {
  const fs::path graphs = graphs_folder();
  const std::vector<std::string> names = starters(graphs);
  if (names.empty()) throw engine::EngineError("there are no starter graphs in " + graphs.string());
  if (arguments.from.empty() || arguments.folder.empty()) {
    if (arguments.list) return std::printf("%s\n", listed_names(names).c_str()), done;
    throw std::invalid_argument("command line: expected facegraph new FOLDER --from NAME, where NAME is one of " +
                                listed_names(names));
  }
  const std::string starter = starter_meant(arguments.from, names);
  const fs::path from = graphs / starter, to = arguments.folder;
  if (fs::exists(to) && (!fs::is_directory(to) || !fs::is_empty(to)))
    throw std::invalid_argument("command line: " + to.string() + " is there already: name a new or an empty folder");

  const std::map<fs::path, fs::path> copies = copies_of(from, graphs);
  for (const auto& [path, inner] : copies)
    if (fs::is_directory(path))
      fs::create_directories(to / inner);
    else
      write_whole((to / inner).string(), text_to_copy(path, copies, from, graphs));
  // Names, ranges and texts while typing, in VS Code.
  write_whole((to / ".vscode" / "graph.schema.json").string(), engine::graph_schema(*open_plugins(common)));
  write_whole((to / ".vscode" / "settings.json").string(),
              "{\n  \"files.associations\": {\"*.json\": \"jsonc\"},\n  \"json.schemas\": [{\"fileMatch\": "
              "[\"/*.json\"], \"url\": "
              "\"./.vscode/graph.schema.json\"}]\n}\n");

  std::printf("%s: graphs from %s\n", to.string().c_str(), starter.c_str());
  for (const auto& [path, inner] : copies)
    if (inner.extension() == ".json" && !inner.has_parent_path()) {
      const std::string text = content_of(path);
      if (text.find("\"nodes\"") == std::string::npos) continue;
      std::printf("  %-24s %s\n", inner.string().c_str(), purpose_of(text).c_str());
    }
  std::printf("How to run each from there is said at its top; facegraph validate GRAPH.json tells what it lacks.\n");
  return done;
}

}  // namespace cli
