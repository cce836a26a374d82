// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <sys/stat.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/base/bytes.h"

namespace engine::store {

// A file descriptor that is closed at the end.
class Fd {
 public:
  Fd() = default;
  explicit Fd(int fd) : fd_(fd) {}
  Fd(Fd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Fd& operator=(Fd&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Fd();
  explicit operator bool() const { return fd_ >= 0; }
  int get() const { return fd_; }
  void close();

 private:
  int fd_ = -1;
};

// Throws the EngineError for a failed call on a store's file: names the store's folder, the file, the cause and what to
// do.
[[noreturn]] void fail_store(const std::string& folder, const std::string& path, int error);

// Makes a folder and its parents where they are missing.
void make_folder(const std::string& folder, const std::string& path);

// Writes everything; false with errno set where that fails.
bool write_all(int fd, const void* data, std::size_t size);

// Writes a file in full, or leaves none and throws.
void write_file(const std::string& folder, const std::string& path, const void* data, std::size_t size, unsigned mode);

// The bytes of an open file; nullopt where reading fails.
std::optional<Bytes> read_all(int fd);

// Names of a folder's entries, without those that start with a dot; none where it does not exist. Not sorted.
void for_each_entry(const std::string& path, const std::function<void(const std::string& name)>& visit);

std::int64_t now_ns();
inline std::int64_t to_ns(const timespec& time) { return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec; }

// Marks a file as used now, by its modification time.
bool touch(const std::string& path);

}  // namespace engine::store
