// SPDX-License-Identifier: Apache-2.0
// Outputs on disk: the only place where a run writes outside its store.
#include <fcntl.h>
#include <linux/fs.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "engine/base/problem.h"
#include "engine/run/session.h"

namespace engine::run {
namespace fs = std::filesystem;
namespace {

struct Descriptor {
  int fd = -1;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

[[noreturn]] void fail(const std::string& what, const std::string& path) {
  throw EngineError("cannot " + what + " " + path + ": " + std::strerror(errno));
}

// Shares the blocks where the file system can, else copies. Never a hard link: the user may edit what is published.
void copy_file(const std::string& from, const std::string& to) {
  const Descriptor in{::open(from.c_str(), O_RDONLY | O_CLOEXEC)};
  if (in.fd < 0) fail("read", from);
  const Descriptor out{::open(to.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)};
  if (out.fd < 0) fail("write", to);
  if (::ioctl(out.fd, FICLONE, in.fd) == 0) return;
  std::vector<char> buffer(1 << 20);
  for (;;) {
    const ssize_t got = ::read(in.fd, buffer.data(), buffer.size());
    if (got < 0) fail("read", from);
    if (got == 0) return;
    for (ssize_t done = 0; done < got;) {
      const ssize_t put = ::write(out.fd, buffer.data() + done, static_cast<std::size_t>(got - done));
      if (put < 0) {
        const int error = errno;
        ::unlink(to.c_str());
        errno = error;
        fail("write", to);
      }
      done += put;
    }
  }
}

bool same_suffix(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](unsigned char x, unsigned char y) {
           return std::tolower(x) == std::tolower(y);
         });
}

class Publisher {
 public:
  Publisher(Session& session, Store& store, RunResult& result) : session_(session), store_(store), result_(result) {}

  void publish(Tree* tree, const fs::path& target) {
    tree = follow(tree);
    if (tree->state == Tree::State::sequence) {
      const Tree::Sequence& held = *tree->sequence;
      const fs::path folder = target.parent_path() / target.stem();
      for (std::size_t i = 0; i < held.children.size(); ++i)
        publish(held.children[i], folder / (held.ids[i] + target.extension().string()));
      return;
    }
    if (tree->state != Tree::State::leaf || !tree->settled) return;
    write(tree, target);
  }

 private:
  void write(Tree* leaf, const fs::path& target) {
    const StoredFile stored = stored_file(leaf->identity, store_);
    if (stored.known && !same_suffix(stored.suffix, target.extension().string()))
      throw EngineError("output " + target.filename().string() + " would hold a file that ends in '" + stored.suffix +
                        "': give it that suffix in the graph's outputs");
    std::error_code ignored;
    if (stored.known && fs::is_regular_file(target, ignored)) {
      const auto present = store_.digest_file(target.string());
      if (present && *present == stored.content) {
        result_.published.push_back(target.string());
        return;
      }
    }
    const Value value = session_.fetch(leaf, type_of<File>());
    const File& file = value.as<File>();
    std::error_code error;
    fs::create_directories(target.parent_path(), error);
    if (error)
      throw EngineError("cannot make the output folder " + target.parent_path().string() + ": " + error.message());
    const fs::path temporary =
        target.parent_path() / ("." + target.filename().string() + "." + std::to_string(::getpid()));
    copy_file(file.path(), temporary.string());
    if (::rename(temporary.c_str(), target.c_str()) != 0) {
      const int cause = errno;
      ::unlink(temporary.c_str());
      errno = cause;
      fail("write", target.string());
    }
    result_.published.push_back(target.string());
  }

  Session& session_;
  Store& store_;
  RunResult& result_;
};

}  // namespace

void Session::publish_outputs(RunResult& result) {
  Publisher publisher(*this, store_, result);
  for (std::size_t i = 0; i < graph_.outputs.size(); ++i) try {
      publisher.publish(output_roots_.at(i), fs::path(options_.out_folder) / graph_.outputs[i].name);
    } catch (const Stopped&) {
      // The run was stopped at a failure, and the store has lost a value that would have to be made again.
    } catch (const EngineError& error) {
      result.failures.push_back("output " + graph_.outputs[i].name + ": " + error.what());  // others may still be had
    }
}

}  // namespace engine::run
