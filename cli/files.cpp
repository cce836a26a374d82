// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "cli/experiments.h"
#include "engine/base/problem.h"

namespace cli {
namespace fs = std::filesystem;

void write_whole(const std::string& path, std::string_view bytes) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error) throw engine::EngineError("cannot make the folder " + folder.string() + ": " + error.message());
  const std::string draft = path + ".part" + std::to_string(::getpid());
  std::FILE* file = std::fopen(draft.c_str(), "wbe");
  const bool written = file && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const bool closed = file && std::fclose(file) == 0;
  if (written && closed && std::rename(draft.c_str(), path.c_str()) == 0) return;
  const std::string why = std::strerror(errno);
  std::remove(draft.c_str());
  throw engine::EngineError("cannot write " + path + ": " + why);
}

std::string graphs_folder() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  return (self.parent_path().parent_path() / "share" / "facegraph" / "graphs").string();
}

std::vector<engine::Setting> settings_of(const std::vector<std::string>& sets) {
  std::vector<engine::Setting> settings;
  for (const std::string& set : sets) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos)
      throw std::invalid_argument("command line: --set " + set + ": expected NAME=VALUE");
    settings.push_back({set.substr(0, equals), set.substr(equals + 1)});
  }
  return settings;
}

std::string shell_word(const std::string& text) {
  if (!text.empty() &&
      text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,@%+") ==
          std::string::npos)
    return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace cli
