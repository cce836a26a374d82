// SPDX-License-Identifier: Apache-2.0
#include "engine/run/values.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "engine/base/problem.h"

namespace engine::run {
namespace fs = std::filesystem;
namespace {

enum class FileKind : std::uint8_t { file, folder };

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// The store moves what it adopts: of a file that is not a task's own, such as one that it was given, it gets a copy.
std::string own_copy(const std::string& path, const Store& store) {
  const std::string root = scratch_root(store);
  if (path.starts_with(root + "/")) return path;
  fs::create_directories(root);
  const std::string copy = root + "/" + std::to_string(::getpid()) + "-" +
                           std::to_string(std::hash<std::thread::id>()(std::this_thread::get_id()));
  fs::copy_file(path, copy, fs::copy_options::overwrite_existing);
  return copy;
}

Bytes file_bytes(const std::string& suffix, const Digest& content) {
  Bytes bytes;
  ByteWriter writer(bytes);
  writer.number(static_cast<std::uint8_t>(FileKind::file));
  writer.text(lower(suffix));
  writer.raw(content.bytes.data(), content.bytes.size());
  return bytes;
}

Digest digest_or_throw(const std::string& path, Store& store) {
  const auto digest = store.digest_file(path);
  if (!digest) throw EngineError("cannot read file " + path + ": " + std::strerror(errno));
  return *digest;
}

}  // namespace

SourceFile open_source(const std::string& path, Store& store) {
  SourceFile source;
  if (!fs::is_directory(path)) {
    source.file = File::at(path);
    source.identity = digest_of(file_bytes(source.file.suffix(), digest_or_throw(path, store)));
    source.paths = {path};
    return source;
  }
  std::vector<File::Entry> entries;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path)) {
    if (entry.is_symlink())
      throw EngineError("folder " + path + " holds a symbolic link, " + entry.path().filename().string() +
                        ": give a folder of plain files");
    if (entry.is_regular_file())
      entries.push_back({entry.path().lexically_relative(path).generic_string(), entry.path().string()});
  }
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  Bytes bytes;
  ByteWriter writer(bytes);
  writer.number(static_cast<std::uint8_t>(FileKind::folder));
  writer.count(entries.size());
  for (const File::Entry& entry : entries) {
    const Digest content = digest_or_throw(entry.path, store);
    writer.text(entry.name);
    writer.raw(content.bytes.data(), content.bytes.size());
    source.paths.push_back(entry.path);
  }
  source.file = File::folder(path, std::move(entries));
  source.identity = digest_of(bytes);
  return source;
}

std::string scratch_root(const Store& store) { return store.folder() + "/scratch"; }

Bytes encode_value(const Value& value, Store& store) {
  if (value.type().name != "file") {
    Bytes bytes;
    ByteWriter writer(bytes);
    value.type().encode(value.data().get(), writer);
    return bytes;
  }
  const File& file = value.as<File>();
  if (file.is_folder()) throw std::logic_error("a node's result is a folder: return a sequence of files instead");
  const std::string suffix = file.suffix();
  if (file.in_memory()) {
    const Bytes content(file.bytes().begin(), file.bytes().end());
    const Digest digest = digest_of(content);
    store.put_file(digest, lower(suffix), content);
    return file_bytes(suffix, digest);
  }
  Hasher hasher;
  std::ifstream in(file.path(), std::ios::binary);
  if (!in) throw EngineError("a node's result cannot be read: " + file.path());
  std::vector<char> buffer(1 << 20);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0)
    hasher.write(std::string_view(buffer.data(), static_cast<std::size_t>(in.gcount())));
  const Digest digest = hasher.finish();
  store.adopt_file(digest, lower(suffix), own_copy(file.path(), store));
  return file_bytes(suffix, digest);
}

StoredFile stored_file(const Digest& identity, Store& store) {
  StoredFile file;
  const auto bytes = store.get(identity);
  if (!bytes) return file;
  ByteReader reader(*bytes);
  if (reader.number<std::uint8_t>() != static_cast<std::uint8_t>(FileKind::file)) return file;
  file.suffix = reader.text();
  reader.raw(file.content.bytes.data(), file.content.bytes.size());
  file.known = true;
  return file;
}

std::optional<Value> load_value(const TypeInfo& type, const Digest& identity, Store& store) {
  if (type.name == "file") {
    const StoredFile file = stored_file(identity, store);
    const std::string path = file.known ? store.file_path(file.content, file.suffix) : std::string();
    if (path.empty()) return std::nullopt;
    return Value::of(File::at(path));
  }
  const auto bytes = store.get(identity);
  if (!bytes) return std::nullopt;
  ByteReader reader(*bytes);
  return Value(type, type.decode(reader));
}

}  // namespace engine::run
