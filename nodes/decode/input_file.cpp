// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "nodes/base/check.h"

namespace face::decode {

namespace {

using Handle = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

Handle open(const std::string& path, const std::string& title) {
  Handle in(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!in) fail(title, ": cannot be opened: ", std::strerror(errno));
  return in;
}

std::uint64_t size_of(std::FILE* in) {
  const bool known = std::fseek(in, 0, SEEK_END) == 0;
  const long size = known ? std::ftell(in) : 0;
  std::rewind(in);
  return size > 0 ? static_cast<std::uint64_t>(size) : 0;
}

std::string read(std::FILE* in, std::size_t count, const std::string& title) {
  std::string bytes(count, '\0');
  bytes.resize(std::fread(bytes.data(), 1, count, in));
  if (std::ferror(in)) fail(title, ": cannot be read after byte ", bytes.size(), ": ", std::strerror(errno));
  return bytes;
}

}  // namespace

std::string read_bytes_at(const std::string& path, const std::string& title) {
  const Handle in = open(path, title);
  return read(in.get(), static_cast<std::size_t>(size_of(in.get())), title);
}

FileStart read_start(const engine::File& file, std::size_t count, const std::string& expected) {
  const std::string title = title_of(file);
  check(!file.is_folder(), title, ": is a folder, expected ", expected);
  check(!file.in_memory(), title, ": is not on disk");
  const Handle in = open(file.path(), title);
  FileStart start{{}, size_of(in.get())};
  start.bytes = read(in.get(), static_cast<std::size_t>(std::min<std::uint64_t>(count, start.size)), title);
  check(!start.bytes.empty(), title, ": is empty (0 bytes), expected ", expected);
  return start;
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
