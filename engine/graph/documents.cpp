// SPDX-License-Identifier: Apache-2.0
#include "engine/graph/documents.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace engine {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = 64 << 20;  // a graph of a million nodes; anything larger is no graph

constexpr std::size_t most_extended = 64;

std::string joined(const std::string& folder, const std::string& path) {
  return (fs::path(folder) / path).lexically_normal().string();
}

}  // namespace

std::string resolve_path(const SourceFile& source, const std::string& path) { return joined(source.folder, path); }
std::string shown_path(const SourceFile& source, const std::string& path) { return joined(source.shown_folder, path); }

const GraphFile& Documents::read(const std::string& path, const std::string& shown, const Place& asked_at) {
  std::vector<std::string> chain;
  return read_extended(path, shown, asked_at, chain);
}

const GraphFile& Documents::read_extended(const std::string& path, const std::string& shown, const Place& asked_at,
                                          std::vector<std::string>& chain) {
  if (const auto known = files_.find(path); known != files_.end()) return *known->second;
  GraphFile& file = *files_.emplace(path, std::make_unique<GraphFile>()).first->second;
  file.path = path;
  file.source.shown = shown;
  file.source.folder = fs::path(path).parent_path().string();
  file.source.shown_folder = fs::path(shown).parent_path().string();
  if (!read_tree(file, asked_at) || !check_version(file)) return file;

  const JsonMember* const extends = file.tree.find("extends");
  if (extends == nullptr) {
    file.usable = true;
    return file;
  }
  if (!extends->value.is(JsonValue::Kind::string) || extends->value.text.empty()) {
    problems_.push_back(
        {extends->value.place(), "found " + found(extends->value) + ", expected the path of a graph file"});
    return file;
  }
  const std::string base_path = resolve_path(file.source, extends->value.text);
  const std::string base_shown = shown_path(file.source, extends->value.text);
  if (chain.size() >= most_extended) {
    problems_.push_back(
        {extends->value.place(), "more than " + std::to_string(most_extended) + " files extend each other"});
    return file;
  }
  chain.push_back(path);
  if (const auto start = std::find(chain.begin(), chain.end(), base_path); start != chain.end()) {
    std::string ring;
    for (auto at = start; at != chain.end(); ++at) ring += files_.at(*at)->source.shown + " extends ";
    problems_.push_back(
        {extends->value.place(), "a file cannot extend itself: " + ring + files_.at(*start)->source.shown});
    return file;
  }
  const GraphFile& base = read_extended(base_path, base_shown, extends->value.place(), chain);
  chain.pop_back();
  if (!base.usable) return file;

  JsonValue patch = std::move(file.tree);
  file.tree = base.tree;
  std::erase_if(patch.members, [](const JsonMember& member) { return member.key == "extends"; });
  merge_patch(file.tree, patch, problems_);
  file.usable = true;
  return file;
}

bool Documents::read_tree(GraphFile& file, const Place& asked_at) {
  const auto fail = [&](const std::string& why) {
    const std::string& shown = file.source.shown;
    if (asked_at.file.empty())
      problems_.push_back({{shown, 0, 0, {}}, why});
    else
      problems_.push_back({asked_at, "the graph file " + shown + " " + why});
    return false;
  };
  std::error_code code;
  const fs::file_status status = fs::status(file.path, code);
  if (!fs::exists(status)) return fail("does not exist");
  if (fs::is_directory(status)) return fail("is a folder, expected a graph file");
  if (!fs::is_regular_file(status)) return fail("is no regular file");
  const std::uintmax_t size = fs::file_size(file.path, code);
  if (code) return fail("cannot be read: " + code.message());
  if (size > most_bytes)
    return fail("has " + std::to_string(size) + " bytes, expected a graph file of at most " +
                std::to_string(most_bytes));
  std::ifstream stream(file.path, std::ios::binary);
  std::string text(size, '\0');
  if (!stream.read(text.data(), static_cast<std::streamsize>(size)))
    return fail(std::string("cannot be read: ") + std::strerror(errno));
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) return fail("is empty, expected a graph file");
  if (!parse_json(text, file.source, file.tree, problems_)) return false;
  if (file.tree.is(JsonValue::Kind::object)) return true;
  problems_.push_back({file.tree.place(), "found " + found(file.tree) + ", expected a graph: {\"facegraph\": 1, ...}"});
  return false;
}

// A graph of another version may mean something else by the same words: nothing more is said about it.
bool Documents::check_version(const GraphFile& file) {
  const JsonMember* const version = file.tree.find("facegraph");
  if (version == nullptr) {
    if (file.tree.find("extends") != nullptr) return true;  // that of the base
    problems_.push_back(
        {file.tree.place(), "the key \"facegraph\" is missing: a graph file starts with \"facegraph\": 1"});
    return false;
  }
  if (version->value.is(JsonValue::Kind::integer) && version->value.integer == 1) return true;
  problems_.push_back({version->value.place(), "found " + found(version->value) +
                                                   ", expected 1: the version of graph files that this program reads"});
  return false;
}

}  // namespace engine
