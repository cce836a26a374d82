// SPDX-License-Identifier: Apache-2.0
#include "engine/plugin/first_load.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "engine/plugin/open_library.h"

extern char** environ;

namespace engine {
namespace fs = std::filesystem;
namespace {

constexpr int kLimitS = 60;                 // no library needs that long to load
constexpr std::size_t kLongestWords = 300;  // of what the process said, in a diagnosis
constexpr int kListDescriptor = 3;          // in the process

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error("it could not be tried in a process of its own: " + what + ": " + std::strerror(errno));
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

// A file in memory that the process writes into: no pipe that fills up, no name on the disk.
class MemoryFile : public Descriptor {
 public:
  explicit MemoryFile(const char* name) : Descriptor(::memfd_create(name, MFD_CLOEXEC)) {
    if (number() < 0) fail("memfd_create");
  }
  std::string text() const {
    std::string all;
    std::array<char, 4096> part;
    for (ssize_t got; (got = ::pread(number(), part.data(), part.size(), static_cast<off_t>(all.size()))) > 0;)
      all.append(part.data(), static_cast<std::size_t>(got));
    return all;
  }
};

struct Actions {
  posix_spawn_file_actions_t list;
  Actions() { ::posix_spawn_file_actions_init(&list); }
  ~Actions() { ::posix_spawn_file_actions_destroy(&list); }
};

std::string one_line(const std::string& text) {
  std::string line;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part);) {
    const std::size_t start = part.find_first_not_of(" \t\r");
    if (start == std::string::npos) continue;
    line += (line.empty() ? "" : "; ") + part.substr(start, part.find_last_not_of(" \t\r") + 1 - start);
  }
  if (line.size() > kLongestWords) line = line.substr(0, kLongestWords) + "...";
  return line;
}

// The status of the ended process; a process that does not end is ended.
int wait_for(pid_t child, bool& too_long) {
  // As a system call: the header of glibc 2.36 declares its function for C alone.
  const Descriptor watched(static_cast<int>(::syscall(SYS_pidfd_open, child, 0)));
  pollfd waiting{watched.number(), POLLIN, 0};
  int ready = 1;
  if (watched.number() >= 0) do
      ready = ::poll(&waiting, 1, kLimitS * 1000);
    while (ready < 0 && errno == EINTR);
  too_long = ready == 0;
  if (too_long) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) fail("waitpid");
  return status;
}

}  // namespace

NodeList first_load(const std::string& path, const std::string& lister) {
  if (::access(lister.c_str(), X_OK) != 0)
    throw std::runtime_error("it has no node list, and the program that would write one cannot be run: " + lister +
                             ": " + std::strerror(errno));
  const MemoryFile list("node list"), said("diagnosis");
  const std::string list_path = "/proc/self/fd/" + std::to_string(kListDescriptor);
  std::array<char*, 4> words = {const_cast<char*>(lister.c_str()), const_cast<char*>(path.c_str()),
                                const_cast<char*>(list_path.c_str()), nullptr};
  Actions actions;
  ::posix_spawn_file_actions_addopen(&actions.list, 0, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions.list, 1, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions.list, said.number(), 2);
  ::posix_spawn_file_actions_adddup2(&actions.list, list.number(), kListDescriptor);
  pid_t child = -1;
  errno = ::posix_spawn(&child, lister.c_str(), &actions.list, nullptr, words.data(), environ);
  if (errno != 0) fail(lister);
  bool too_long = false;
  const int status = wait_for(child, too_long);

  if (too_long) throw std::runtime_error("its first load did not end within " + std::to_string(kLimitS) + " s");
  const std::string words_said = one_line(said.text());
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) try {
      return read_node_list(list.text());
    } catch (const std::runtime_error&) {
      throw std::runtime_error("its first load ended without a node list");
    }
  if (const std::size_t at = words_said.find(unusable(path)); WIFEXITED(status) && at != std::string::npos)
    throw std::runtime_error(words_said.substr(at + unusable(path).size()));
  const std::string end =
      WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status)) + " (" + ::sigdescr_np(WTERMSIG(status)) + ")"
                          : "exit code " + std::to_string(WEXITSTATUS(status));
  throw std::runtime_error("its first load ended with " + end + (words_said.empty() ? "" : ": " + words_said));
}

std::string lister_beside_this_program() {
  std::error_code error;
  return (fs::read_symlink("/proc/self/exe", error).parent_path() / "facegraph_list_nodes").string();
}

}  // namespace engine
