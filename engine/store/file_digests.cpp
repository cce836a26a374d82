// SPDX-License-Identifier: Apache-2.0
#include "engine/store/file_digests.h"

#include <fcntl.h>

#include <algorithm>

#include "engine/store/objects.h"
#include "engine/store/posix.h"

namespace engine::store {
namespace {

// A file that was changed this shortly before it was read may change again without its times telling (they advance in
// steps of a few milliseconds, on some file systems of 2 s): its digest is not remembered.
constexpr std::int64_t kDoubtNs = 2'000'000'000;
constexpr int kTries = 5;

}  // namespace

std::optional<Digest> FileDigests::digest(const std::string& path) {
  struct stat found;
  if (stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  FileState state = state_of(found);
  std::optional<Entries::FileDigest> known = journal_.file_digest(state.device, state.inode);
  if (!known) known = index_.file_digest(state.device, state.inode);
  if (known && known->state == state) {
    const std::lock_guard lock(mutex_);
    seen_[path] = state;
    return known->digest;
  }
  const Fd fd(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!fd) return std::nullopt;
  std::optional<Digest> digest;
  for (int tried = 0; tried < kTries; ++tried) {
    if (fstat(fd.get(), &found) != 0) return std::nullopt;
    state = state_of(found);
    const std::int64_t start_ns = now_ns();
    digest = hash_file(fd.get());
    if (!digest || fstat(fd.get(), &found) != 0) return std::nullopt;
    if (state_of(found) != state) continue;  // written meanwhile
    if (std::max(state.mtime_ns, state.ctime_ns) < start_ns - kDoubtNs) journal_.add_file_digest(state, *digest);
    break;
  }
  const std::lock_guard lock(mutex_);
  seen_[path] = state;
  return digest;
}

bool FileDigests::unchanged(const std::string& path) {
  struct stat found;
  if (stat(path.c_str(), &found) != 0) return false;
  const std::lock_guard lock(mutex_);
  const auto known = seen_.find(path);
  return known != seen_.end() && known->second == state_of(found);
}

}  // namespace engine::store
