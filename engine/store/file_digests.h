// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "engine/store/index.h"
#include "engine/store/journal.h"

namespace engine::store {

// Digests of files outside the store, remembered by (device, inode, size, mtime, ctime) across runs.
class FileDigests {
 public:
  FileDigests(Index& index, Journal& journal) : index_(index), journal_(journal) {}

  std::optional<Digest> digest(const std::string& path);
  bool unchanged(const std::string& path);

 private:
  Index& index_;
  Journal& journal_;
  std::mutex mutex_;
  std::unordered_map<std::string, FileState> seen_;
};

}  // namespace engine::store
