// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/opened_files.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/types.h>

#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <mutex>
#include <set>

namespace conformance {
namespace {

std::atomic<bool> noting = false;
std::mutex mutex;
std::set<std::string>& noted() {
  static std::set<std::string> paths;
  return paths;
}

bool of_the_system(const std::string& path) {
  for (const char* place : {"/proc/", "/sys/", "/dev/", "/lib", "/usr/lib/", "/etc/localtime", "/usr/share/zoneinfo/",
                            "/etc/ld.so", "/etc/ssl/", "/usr/share/locale/"})
    if (path.rfind(place, 0) == 0) return true;
  return path.find(".so") != std::string::npos || path.find("gdalrc") != std::string::npos;  // of OpenCV's libraries
}

void note(const char* path) {
  if (!noting || !path || of_the_system(path)) return;
  const std::lock_guard guard(mutex);
  noted().insert(path);
}

// The C library's own function behind one that stands before it here.
template <class F>
F next(const char* name) {
  return reinterpret_cast<F>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

OpenedFiles::OpenedFiles() {
  const std::lock_guard guard(mutex);
  noted().clear();
  noting = true;
}
OpenedFiles::~OpenedFiles() { noting = false; }

std::vector<std::string> OpenedFiles::paths() const {
  const std::lock_guard guard(mutex);
  return {noted().begin(), noted().end()};
}

}  // namespace conformance

extern "C" {

#define FACEGRAPH_OPEN(name)                                                             \
  __attribute__((visibility("default"))) int name(const char* path, int flags, ...) {    \
    va_list arguments;                                                                   \
    va_start(arguments, flags);                                                          \
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) ? va_arg(arguments, mode_t) : 0; \
    va_end(arguments);                                                                   \
    if ((flags & O_ACCMODE) != O_WRONLY) conformance::note(path);                        \
    static const auto real = conformance::next<int (*)(const char*, int, ...)>(#name);   \
    return real(path, flags, mode);                                                      \
  }
FACEGRAPH_OPEN(open)
FACEGRAPH_OPEN(open64)

#define FACEGRAPH_FOPEN(name)                                                               \
  __attribute__((visibility("default"))) FILE* name(const char* path, const char* mode) {   \
    if (mode && mode[0] == 'r') conformance::note(path);                                    \
    static const auto real = conformance::next<FILE* (*)(const char*, const char*)>(#name); \
    return real(path, mode);                                                                \
  }
FACEGRAPH_FOPEN(fopen)
FACEGRAPH_FOPEN(fopen64)
}
