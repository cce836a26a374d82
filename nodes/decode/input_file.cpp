// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/input_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "nodes/base/check.h"

namespace face::decode {

std::string read_bytes_at(const std::string& path, const std::string& title) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!in) fail(title, ": cannot be opened: ", std::strerror(errno));
  std::string bytes;
  if (std::fseek(in.get(), 0, SEEK_END) == 0) {
    const long size = std::ftell(in.get());
    std::rewind(in.get());
    if (size > 0) bytes.reserve(static_cast<std::size_t>(size));
  }
  char buffer[1 << 16];
  for (std::size_t got; (got = std::fread(buffer, 1, sizeof buffer, in.get())) > 0;) bytes.append(buffer, got);
  if (std::ferror(in.get())) fail(title, ": cannot be read after byte ", bytes.size(), ": ", std::strerror(errno));
  return bytes;
}

std::string title_of(const engine::File& file) {
  if (!file.name().empty()) return file.name();
  return file.is_folder() ? "the folder" : "the data";
}

std::string read_bytes(const engine::File& file) {
  check(!file.is_folder(), title_of(file), ": is a folder, expected a file");
  if (file.in_memory()) return file.bytes();
  return read_bytes_at(file.path(), title_of(file));
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string lower_suffix(const engine::File& file) { return lower(file.suffix()); }

}  // namespace face::decode
