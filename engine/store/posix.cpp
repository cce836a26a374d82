// SPDX-License-Identifier: Apache-2.0
#include "engine/store/posix.h"

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <system_error>

#include "engine/base/problem.h"

namespace engine::store {

Fd::~Fd() { close(); }

void Fd::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

void fail_store(const std::string& folder, const std::string& path, int error) {
  const std::string cause = std::string(std::strerror(error)) + ": " + path;
  if (error == ENOSPC || error == EDQUOT || error == EFBIG)
    throw EngineError("the store in " + folder + " is full (" + cause +
                      "): free space on that disk, or choose another folder with --store");
  if (error == EROFS || error == EACCES || error == EPERM)
    throw EngineError("the store in " + folder + " cannot be written (" + cause +
                      "): make the folder writable, or choose another with --store");
  if (error == ENOTDIR || error == EEXIST)
    throw EngineError("the store in " + folder + " cannot be made (" + cause +
                      " is a file, expected a folder): choose another folder with --store");
  if (error == EMFILE || error == ENFILE)
    throw EngineError("the store in " + folder + " cannot open a file (" + cause + "): raise the limit with ulimit -n");
  throw EngineError("the store in " + folder + " cannot be used (" + cause +
                    "): check that disk, or choose another folder with --store");
}

void make_folder(const std::string& folder, const std::string& path) {
  if (mkdir(path.c_str(), 0777) == 0) return;
  if (errno == EEXIST) {
    struct stat found;
    if (stat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode)) return;
    fail_store(folder, path, ENOTDIR);
  }
  if (errno != ENOENT) fail_store(folder, path, errno);
  const std::size_t slash =
      path.find_last_not_of('/') == std::string::npos ? std::string::npos : path.find_last_of('/');
  if (slash == std::string::npos || slash == 0) fail_store(folder, path, ENOENT);
  make_folder(folder, path.substr(0, slash));
  if (mkdir(path.c_str(), 0777) != 0 && errno != EEXIST) fail_store(folder, path, errno);
}

bool write_all(int fd, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = write(fd, at, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    if (written == 0) {
      errno = ENOSPC;
      return false;
    }
    at += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

void write_file(const std::string& folder, const std::string& path, const void* data, std::size_t size, unsigned mode) {
  const Fd fd(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  if (!fd) fail_store(folder, path, errno);
  if (write_all(fd.get(), data, size)) return;
  const int error = errno;
  unlink(path.c_str());
  fail_store(folder, path, error);
}

std::optional<Bytes> read_all(int fd) {
  struct stat found;
  if (fstat(fd, &found) != 0) return std::nullopt;
  Bytes bytes(static_cast<std::size_t>(found.st_size));
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = pread(fd, bytes.data() + filled, bytes.size() - filled, static_cast<off_t>(filled));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
  }
  bytes.resize(filled);
  return bytes;
}

void for_each_entry(const std::string& path, const std::function<void(const std::string& name)>& visit) {
  DIR* const opened = opendir(path.c_str());
  if (opened == nullptr) return;
  struct Closer {
    DIR* folder;
    ~Closer() { closedir(folder); }
  } const closer{opened};
  while (const dirent* entry = readdir(opened))
    if (entry->d_name[0] != '.') visit(entry->d_name);
}

std::int64_t now_ns() {
  timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  return to_ns(now);
}

bool touch(const std::string& path) { return utimensat(AT_FDCWD, path.c_str(), nullptr, 0) == 0; }

}  // namespace engine::store
