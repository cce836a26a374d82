// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "engine/base/bytes.h"
#include "engine/base/digest.h"
#include "engine/store/journal.h"

namespace engine::store {

// The bytes of a store that lie in files of their own: objects/ab/cdef... (values, zstd) and files/ab/cdef....suffix
// (what nodes made as files, as they are, read-only). Each appears by one rename from tmp/, so that it is whole or
// absent. The modification time says when it was used last. No lock is held here during compression, hashing or I/O.
class Objects {
 public:
  // owner: name of this process's lease, which begins the names of its temporary files. What was used since
  // lease_start_ns need not be marked again.
  Objects(std::string folder, std::string owner, std::int64_t lease_start_ns)
      : folder_(std::move(folder)), owner_(std::move(owner)), lease_start_ns_(lease_start_ns) {}

  void put(const Digest& digest, const Bytes& bytes);
  enum class Found { no, damaged, yes };  // damaged: it was removed
  Found get(const Digest& digest, Bytes& bytes);
  bool has(const Digest& digest);

  void put_file(const Digest& digest, const std::string& suffix, const Bytes& content);
  void adopt_file(const Digest& digest, const std::string& suffix, const std::string& path);
  Found check_file(const Digest& digest, const std::string& suffix, std::string& path);
  bool has_file(const Digest& digest, const std::string& suffix);

  // Visits everything: path, digest, whether it is a file value, its size and when it was used last.
  struct Item {
    std::string path;
    Digest digest;
    bool is_file = false;
    std::uint64_t size = 0;
    std::int64_t used_ns = 0;
  };
  void for_each(const std::function<void(Item)>& visit) const;
  // Checks an item's content against its digest and removes it where it is damaged.
  Found check(const Item& item);
  // Removes an item unless it was used at or after spare_ns. It is moved out of sight before its time is read, so that
  // whoever marks it as used either is seen here or finds it absent.
  bool remove_unused(const Item& item, std::int64_t spare_ns);

  std::string temporary_path();

 private:
  std::string object_path(const Digest& digest) const;
  std::string file_path(const Digest& digest, const std::string& suffix) const;
  bool used(const std::string& path);
  void move_in(const std::string& temporary, const std::string& path);

  const std::string folder_, owner_;
  const std::int64_t lease_start_ns_;
  std::atomic<std::uint64_t> temporaries_{0};
  std::mutex verified_mutex_;
  std::unordered_map<std::string, FileState> verified_;
};

// SHA-256 of an open file, read in pieces of 1 MB; nullopt where reading fails.
std::optional<Digest> hash_file(int fd);
FileState state_of(const struct stat& found);

}  // namespace engine::store
