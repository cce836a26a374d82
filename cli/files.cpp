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

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string beginning(const std::string& text, std::size_t most_bytes) {
  if (text.size() <= most_bytes) return text;
  std::size_t end = most_bytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end);
}

std::string shortened(const std::string& text) {
  constexpr std::size_t most_bytes = 60;
  return text.size() <= most_bytes ? text : beginning(text, most_bytes - 3) + "...";
}

}  // namespace cli
