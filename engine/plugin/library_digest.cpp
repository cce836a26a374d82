// SPDX-License-Identifier: Apache-2.0
#include "engine/plugin/library_digest.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>

#include "engine/base/bytes.h"
#include "engine/plugin/elf_file.h"

namespace engine {
namespace fs = std::filesystem;
namespace {

// Where the loader looks last. Debian's own folders, and what /etc/ld.so.conf.d adds on a fresh system.
constexpr std::array<const char*, 7> kStandardFolders = {"/usr/local/lib/x86_64-linux-gnu",
                                                         "/usr/local/lib",
                                                         "/lib/x86_64-linux-gnu",
                                                         "/usr/lib/x86_64-linux-gnu",
                                                         "/lib64",
                                                         "/lib",
                                                         "/usr/lib"};

// The engine's inline part is in the plugin, the rest of it is a number in the key. The runtime keeps what it does.
bool never_counts(std::string_view soname) {
  constexpr std::array<std::string_view, 9> names = {"libengine.so", "libc.so",     "libm.so",
                                                     "libstdc++.so", "libgcc_s.so", "libpthread.so",
                                                     "libdl.so",     "librt.so",    "ld-linux"};
  return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return soname.starts_with(name); });
}

struct Found {
  std::string path;
  bool own = false;
};

class Digester {
 public:
  explicit Digester(const std::vector<std::string>& own_folders) {
    for (const std::string& folder : own_folders) own_folders_.push_back(plain(folder));
    if (const char* const set = std::getenv("LD_LIBRARY_PATH")) {
      const std::string folders = set;
      for (std::size_t at = 0; at < folders.size();) {
        const std::size_t end = std::min(folders.find(':', at), folders.size());
        if (end > at) loader_folders_.push_back(folders.substr(at, end - at));
        at = end + 1;
      }
    }
  }

  Digest digest(const std::string& path) {
    const auto known = digests_.find(path);
    if (known != digests_.end()) return known->second;
    const ElfFile library(path);
    Bytes bytes;
    ByteWriter writer(bytes);
    const Digest code = code_digest(library);
    writer.raw(code.bytes.data(), code.bytes.size());
    digests_[path] = code;  // for a library that needs itself in a circle
    for (const std::string& soname : library.needed()) {
      if (never_counts(soname)) continue;
      writer.text(soname);
      const std::optional<Found> found = find(soname, path, library.run_path());
      if (!found) continue;  // loading will say so
      if (found->own) {
        const Digest inner = digest(found->path);
        writer.raw(inner.bytes.data(), inner.bytes.size());
      } else {
        const Digest content = foreign_digest(found->path);
        writer.raw(content.bytes.data(), content.bytes.size());
      }
    }
    return digests_[path] = digest_of(std::span<const std::uint8_t>(bytes));
  }

 private:
  static std::string plain(const fs::path& folder) {
    std::error_code error;
    const fs::path resolved = fs::weakly_canonical(folder, error);
    return error ? folder.string() : resolved.string();
  }

  static Digest code_digest(const ElfFile& library) {
    Hasher hasher;
    for (const ElfFile::Segment& segment : library.loadable_segments()) {
      Bytes head;
      ByteWriter writer(head);
      writer.number(segment.address);
      writer.number(segment.size_in_memory);
      writer.number(segment.flags);
      writer.count(segment.bytes.size());
      hasher.write(std::span<const std::uint8_t>(head)).write(segment.bytes);
    }
    return hasher.finish();
  }

  static Digest foreign_digest(const std::string& path) {
    Bytes id = ElfFile::build_id_at_start(path);
    if (!id.empty()) return digest_of(std::span<const std::uint8_t>(id));
    const ElfFile whole(path);
    return whole.build_id().empty() ? code_digest(whole) : digest_of(std::span<const std::uint8_t>(whole.build_id()));
  }

  // In the loader's order; our own folders come last, for libraries that were linked without a run path.
  std::optional<Found> find(const std::string& soname, const std::string& needed_by,
                            const std::vector<std::string>& run_path) const {
    const std::string origin =
        plain(fs::path(needed_by).parent_path().empty() ? fs::path(".") : fs::path(needed_by).parent_path());
    const auto look = [&](const std::string& folder, bool relative) -> std::optional<Found> {
      std::error_code error;
      const fs::path path = fs::path(folder) / soname;
      if (!fs::is_regular_file(path, error)) return std::nullopt;
      const bool listed = std::find(own_folders_.begin(), own_folders_.end(), plain(folder)) != own_folders_.end();
      return Found{path.string(), relative || listed};
    };
    for (const std::string& folder : loader_folders_)
      if (auto found = look(folder, false)) return found;
    for (std::string folder : run_path) {
      bool relative = false;
      for (const std::string_view variable : {"${ORIGIN}", "$ORIGIN"})
        for (std::size_t at; (at = folder.find(variable)) != std::string::npos; relative = true)
          folder.replace(at, variable.size(), origin);
      if (auto found = look(folder, relative)) return found;
    }
    for (const char* folder : kStandardFolders)
      if (auto found = look(folder, false)) return found;
    for (const std::string& folder : own_folders_)
      if (auto found = look(folder, true)) return found;
    return std::nullopt;
  }

  std::vector<std::string> own_folders_, loader_folders_;
  std::map<std::string, Digest> digests_;
};

}  // namespace

Digest library_digest(const std::string& path, const std::vector<std::string>& own_library_folders) {
  return Digester(own_library_folders).digest(path);
}

std::string read_section(const std::string& path, std::string_view name) { return ElfFile(path).section(name); }

}  // namespace engine
