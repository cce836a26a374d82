// SPDX-License-Identifier: Apache-2.0
#include "engine/store/objects.h"

#include <fcntl.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "engine/base/problem.h"
#include "engine/store/posix.h"

namespace engine::store {
namespace {

constexpr int kCompressionLevel =
    1;  // about as quick as hashing; higher levels are slower than recomputing many a frame
constexpr std::size_t kBufferBytes = 1 << 20;

template <auto Free>
struct Freed {
  template <class T>
  void operator()(T* pointer) const {
    Free(pointer);
  }
};

Bytes compress(const Bytes& bytes) {
  // One context a thread: making one costs more than compressing a small value.
  thread_local const std::unique_ptr<ZSTD_CCtx, Freed<ZSTD_freeCCtx>> context(ZSTD_createCCtx());
  Bytes packed(ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compressCCtx(context.get(), packed.data(), packed.size(), bytes.data(), bytes.size(), kCompressionLevel);
  if (ZSTD_isError(size)) throw EngineError(std::string("zstd cannot compress a value: ") + ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

bool decompress(const Bytes& packed, Bytes& bytes) {
  thread_local const std::unique_ptr<ZSTD_DCtx, Freed<ZSTD_freeDCtx>> context(ZSTD_createDCtx());
  const unsigned long long size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR) return false;
  // The size may be damaged, and must not ask for all memory: a value that claims to have shrunk a lot is unpacked
  // piecemeal.
  const std::uint64_t likely = packed.size() * 16 + (1 << 16);
  if (size <= likely) {
    bytes.resize(static_cast<std::size_t>(size));
    return ZSTD_decompressDCtx(context.get(), bytes.data(), bytes.size(), packed.data(), packed.size()) == bytes.size();
  }
  ZSTD_DCtx_reset(context.get(), ZSTD_reset_session_only);
  bytes.resize(static_cast<std::size_t>(likely));
  ZSTD_inBuffer from{packed.data(), packed.size(), 0};
  ZSTD_outBuffer to{bytes.data(), bytes.size(), 0};
  while (true) {
    const std::size_t state = ZSTD_decompressStream(context.get(), &to, &from);
    if (ZSTD_isError(state)) return false;
    if (state == 0) break;
    if (to.pos == to.size) {
      bytes.resize(static_cast<std::size_t>(std::min<std::uint64_t>(size, bytes.size() * 4)));
      if (bytes.size() == to.size) return false;
      to.dst = bytes.data();
      to.size = bytes.size();
    } else if (from.pos == from.size) {
      return false;
    }
  }
  return to.pos == size && bytes.size() == size;
}

std::string shard(const std::string& folder, const char* kind, const Digest& digest) {
  const std::string hex = digest.hex();
  std::string path;
  path.reserve(folder.size() + 80);
  path.append(folder).append(1, '/').append(kind).append(1, '/').append(hex, 0, 2).append(1, '/').append(hex, 2);
  return path;
}

void check_suffix(const std::string& suffix) {
  if (suffix.empty()) return;
  if (suffix[0] != '.' || suffix.size() > 60 || suffix.find('/') != std::string::npos ||
      suffix.find('\0') != std::string::npos)
    throw std::invalid_argument("the suffix of a file is '" + suffix + "', expected a dot and a name");
}

}  // namespace

FileState state_of(const struct stat& found) {
  return {static_cast<std::uint64_t>(found.st_dev), static_cast<std::uint64_t>(found.st_ino),
          static_cast<std::uint64_t>(found.st_size), to_ns(found.st_mtim), to_ns(found.st_ctim)};
}

std::optional<Digest> hash_file(int fd) {
  thread_local const std::unique_ptr<std::uint8_t[]> buffer(new std::uint8_t[kBufferBytes]);
  Hasher hasher;
  off_t at = 0;
  while (true) {
    const ssize_t got = pread(fd, buffer.get(), kBufferBytes, at);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) return hasher.finish();
    hasher.write(std::span<const std::uint8_t>(buffer.get(), static_cast<std::size_t>(got)));
    at += got;
  }
}

std::string Objects::temporary_path() {
  return folder_ + "/tmp/" + owner_ + "-" + std::to_string(temporaries_.fetch_add(1, std::memory_order_relaxed));
}

std::string Objects::object_path(const Digest& digest) const { return shard(folder_, "objects", digest); }

std::string Objects::file_path(const Digest& digest, const std::string& suffix) const {
  check_suffix(suffix);
  return shard(folder_, "files", digest) + suffix;
}

// Whether it exists; marks it as used.
bool Objects::used(const std::string& path) {
  struct stat found;
  if (stat(path.c_str(), &found) != 0) return false;
  return to_ns(found.st_mtim) >= lease_start_ns_ || touch(path);
}

void Objects::move_in(const std::string& temporary, const std::string& path) {
  if (rename(temporary.c_str(), path.c_str()) == 0) return;
  if (errno == ENOENT) {
    make_folder(folder_, path.substr(0, path.rfind('/')));
    if (rename(temporary.c_str(), path.c_str()) == 0) return;
  }
  const int error = errno;
  unlink(temporary.c_str());
  fail_store(folder_, path, error);
}

void Objects::put(const Digest& digest, const Bytes& bytes) {
  const std::string path = object_path(digest);
  if (used(path)) return;
  const Bytes packed = compress(bytes);
  const std::string temporary = temporary_path();
  write_file(folder_, temporary, packed.data(), packed.size(), 0444);
  move_in(temporary, path);
}

Objects::Found Objects::get(const Digest& digest, Bytes& bytes) {
  const std::string path = object_path(digest);
  const Fd fd(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!fd) {
    if (errno == ENOENT) return Found::no;
    fail_store(folder_, path, errno);
  }
  struct stat found;
  if (fstat(fd.get(), &found) == 0 && to_ns(found.st_mtim) < lease_start_ns_) touch(path);
  const std::optional<Bytes> packed = read_all(fd.get());
  if (packed && decompress(*packed, bytes) && digest_of(std::span<const std::uint8_t>(bytes)) == digest)
    return Found::yes;
  unlink(path.c_str());
  return Found::damaged;
}

bool Objects::has(const Digest& digest) { return used(object_path(digest)); }

void Objects::put_file(const Digest& digest, const std::string& suffix, const Bytes& content) {
  const std::string path = file_path(digest, suffix);
  if (used(path)) return;
  const std::string temporary = temporary_path();
  write_file(folder_, temporary, content.data(), content.size(), 0444);
  move_in(temporary, path);
}

void Objects::adopt_file(const Digest& digest, const std::string& suffix, const std::string& path) {
  const std::string target = file_path(digest, suffix);
  if (used(target)) {
    unlink(path.c_str());
    return;
  }
  const std::string temporary = temporary_path();
  if (rename(path.c_str(), temporary.c_str()) == 0) {
    chmod(temporary.c_str(), 0444);
    touch(temporary);
  } else if (errno == EXDEV) {
    const Fd source(open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!source) fail_store(folder_, path, errno);
    const Fd copy(open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0444));
    if (!copy) fail_store(folder_, temporary, errno);
    const std::unique_ptr<std::uint8_t[]> buffer(new std::uint8_t[kBufferBytes]);
    while (true) {
      const ssize_t got = read(source.get(), buffer.get(), kBufferBytes);
      if (got == 0) break;
      if (got < 0 || !write_all(copy.get(), buffer.get(), static_cast<std::size_t>(got))) {
        const int error = errno;
        unlink(temporary.c_str());
        fail_store(folder_, temporary, error);
      }
    }
    unlink(path.c_str());
  } else {
    fail_store(folder_, path, errno);
  }
  move_in(temporary, target);
}

bool Objects::has_file(const Digest& digest, const std::string& suffix) { return used(file_path(digest, suffix)); }

Objects::Found Objects::check_file(const Digest& digest, const std::string& suffix, std::string& path) {
  std::string name = file_path(digest, suffix);
  if (!used(name)) return Found::no;
  const Fd fd(open(name.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat found;
  if (!fd || fstat(fd.get(), &found) != 0) return Found::no;
  const FileState state = state_of(found);
  {
    const std::lock_guard lock(verified_mutex_);
    const auto known = verified_.find(name);
    if (known != verified_.end() && known->second == state) {
      path = std::move(name);
      return Found::yes;
    }
  }
  if (hash_file(fd.get()) != digest) {
    unlink(name.c_str());
    return Found::damaged;
  }
  const std::lock_guard lock(verified_mutex_);
  verified_[name] = state;
  path = std::move(name);
  return Found::yes;
}

void Objects::for_each(const std::function<void(Item)>& visit) const {
  for (const bool is_file : {false, true}) {
    const std::string top = folder_ + (is_file ? "/files" : "/objects");
    for_each_entry(top, [&](const std::string& first) {
      if (first.size() != 2) return;
      for_each_entry(top + "/" + first, [&](const std::string& rest) {
        if (rest.size() < 62 || (!is_file && rest.size() != 62)) return;
        Item item;
        try {
          item.digest = Digest::from_hex(first + rest.substr(0, 62));
        } catch (const std::invalid_argument&) {
          return;
        }
        item.path = top + "/" + first + "/" + rest;
        item.is_file = is_file;
        struct stat found;
        if (lstat(item.path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return;
        item.size = static_cast<std::uint64_t>(found.st_size);
        item.used_ns = to_ns(found.st_mtim);
        visit(std::move(item));
      });
    });
  }
}

Objects::Found Objects::check(const Item& item) {
  const Fd fd(open(item.path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!fd) return Found::no;
  bool good = false;
  if (item.is_file) {
    good = hash_file(fd.get()) == item.digest;
  } else {
    const std::optional<Bytes> packed = read_all(fd.get());
    Bytes bytes;
    good = packed && decompress(*packed, bytes) && digest_of(std::span<const std::uint8_t>(bytes)) == item.digest;
  }
  if (good) return Found::yes;
  unlink(item.path.c_str());
  return Found::damaged;
}

bool Objects::remove_unused(const Item& item, std::int64_t spare_ns) {
  const std::string hidden = temporary_path();
  if (rename(item.path.c_str(), hidden.c_str()) != 0) return false;
  struct stat found;
  if (stat(hidden.c_str(), &found) == 0 && to_ns(found.st_mtim) >= spare_ns) {
    rename(hidden.c_str(), item.path.c_str());
    return false;
  }
  return unlink(hidden.c_str()) == 0;
}

}  // namespace engine::store
