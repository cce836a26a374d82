// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/port.h"

namespace face::decode {

// The whole content of a file, on disk or in memory. Throws, naming the file, where it cannot be read or is a folder.
std::string read_bytes(const engine::File& file);

// The same for a path; `title` is what messages call it.
std::string read_bytes_at(const std::string& path, const std::string& title);

// The first bytes of a file on disk, at most `count`, and its size. Throws, naming the file, where it cannot be read,
// is a folder, or is empty; `expected` says what would serve.
struct FileStart {
  std::string bytes;
  std::uint64_t size = 0;
};
FileStart read_start(const engine::File& file, std::size_t count, const std::string& expected);

// What messages call a file: its name, or "the data" for one without.
std::string title_of(const engine::File& file);

// The suffix in lower case, with the dot.
std::string lower_suffix(const engine::File& file);

// ASCII lower case, whatever the locale.
std::string lower(std::string text);

}  // namespace face::decode
