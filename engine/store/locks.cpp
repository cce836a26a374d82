// SPDX-License-Identifier: Apache-2.0
#include "engine/store/locks.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace engine::store {
namespace {

constexpr std::size_t kPage = 4096;
constexpr std::int64_t kKeyMask = (std::int64_t{1} << 62) - 1;

struct flock range(short type, std::int64_t offset, std::int64_t length) {
  struct flock lock = {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = offset;
  lock.l_len = length;
  return lock;
}

std::int64_t offset_of(const Digest& key) {
  std::int64_t offset;
  std::memcpy(&offset, key.bytes.data(), sizeof offset);
  return offset & kKeyMask;
}

std::string random_name() {
  std::uint64_t number = 0;
  if (getrandom(&number, sizeof number, 0) != sizeof number) number = static_cast<std::uint64_t>(now_ns());
  char text[48];
  std::snprintf(text, sizeof text, "%ld.%016llx", static_cast<long>(getpid()), static_cast<unsigned long long>(number));
  return text;
}

}  // namespace

bool lock_range(int fd, std::int64_t offset, std::int64_t length, bool wait) {
  struct flock lock = range(F_WRLCK, offset, length);
  while (fcntl(fd, wait ? F_OFD_SETLKW : F_OFD_SETLK, &lock) != 0)
    if (errno != EINTR) return false;
  return true;
}

void unlock_range(int fd, std::int64_t offset, std::int64_t length) {
  struct flock lock = range(F_UNLCK, offset, length);
  fcntl(fd, F_OFD_SETLK, &lock);
}

bool is_locked_elsewhere(int fd) {
  struct flock lock = range(F_WRLCK, 0, 1);
  return fcntl(fd, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

Shared::Shared(const std::string& folder) : folder_(folder), path_(folder + "/shared") {
  file_ = Fd(open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (!file_) fail_store(folder_, path_, errno);
  // Allocated, not sparse: a store into a mapped page that the disk has no room for would be a signal, not an error.
  const int error = posix_fallocate(file_.get(), 0, kPage);
  if (error != 0) fail_store(folder_, path_, error);
  void* const page = mmap(nullptr, kPage, PROT_READ | PROT_WRITE, MAP_SHARED, file_.get(), 0);
  if (page == MAP_FAILED) fail_store(folder_, path_, errno);
  counter_ = static_cast<std::atomic<std::uint64_t>*>(page);
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
}

Shared::~Shared() { munmap(counter_, kPage); }

class Shared::Held final : public Store::KeyLock {
 public:
  Held(std::shared_ptr<Shared> shared, std::int64_t offset) : shared_(std::move(shared)), offset_(offset) {}
  ~Held() override {
    const std::lock_guard lock(shared_->mutex_);
    unlock_range(shared_->file_.get(), offset_, 1);
    shared_->held_.erase(offset_);
  }

 private:
  const std::shared_ptr<Shared> shared_;
  const std::int64_t offset_;
};

std::unique_ptr<Store::KeyLock> Shared::try_lock(const std::shared_ptr<Shared>& self, const Digest& key) {
  const std::int64_t offset = offset_of(key);
  const std::lock_guard lock(mutex_);
  if (!held_.insert(offset).second) return nullptr;
  if (!lock_range(file_.get(), offset, 1, false)) {
    const int error = errno;
    held_.erase(offset);
    if (error != EAGAIN && error != EACCES) fail_store(folder_, path_, error);
    return nullptr;
  }
  return std::make_unique<Held>(self, offset);
}

bool Shared::holds(const Digest& key) const {
  const std::lock_guard lock(mutex_);
  return held_.contains(offset_of(key));
}

Shared::Section::Section(Shared& shared, std::int64_t offset)
    : file_(open(shared.path_.c_str(), O_RDWR | O_CLOEXEC)), offset_(offset) {
  if (!file_ || !lock_range(file_.get(), offset_, 1, true)) fail_store(shared.folder_, shared.path_, errno);
}

Shared::Section::~Section() { unlock_range(file_.get(), offset_, 1); }

void Shared::announce() {
  own_.fetch_add(1, std::memory_order_release);
  counter_->fetch_add(1, std::memory_order_release);
}

std::uint64_t Shared::news_of_others() const {
  const std::uint64_t own = own_.load(std::memory_order_acquire);
  return counter_->load(std::memory_order_acquire) - own;
}

Lease::Lease(const std::string& folder) : owner_(random_name()) {
  path_ = folder + "/leases/" + owner_;
  // Locked before it has its name: nobody can see it free.
  const std::string unnamed = folder + "/leases/." + owner_;
  file_ = Fd(open(unnamed.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  struct stat found;
  if (!file_ || !lock_range(file_.get(), 0, 1, false) || fstat(file_.get(), &found) != 0 ||
      rename(unnamed.c_str(), path_.c_str()) != 0)
    fail_store(folder, path_, errno);
  start_ns_ = to_ns(found.st_mtim);
}

void Lease::end() {
  unlink(path_.c_str());
  file_.close();
}

std::vector<OtherLease> live_leases(const std::string& folder, const std::string& except) {
  std::vector<OtherLease> live;
  for_each_entry(folder + "/leases", [&](const std::string& owner) {
    if (owner == except) return;
    const Fd file(open((folder + "/leases/" + owner).c_str(), O_RDWR | O_CLOEXEC));
    struct stat found;
    if (file && is_locked_elsewhere(file.get()) && fstat(file.get(), &found) == 0)
      live.push_back({owner, to_ns(found.st_mtim)});
  });
  return live;
}

void visit_dead_leases(const std::string& folder, const std::function<void(const std::string& owner)>& inherit) {
  std::vector<std::string> owners;
  for_each_entry(folder + "/leases", [&](const std::string& owner) { owners.push_back(owner); });
  for (const std::string& owner : owners) {
    const std::string path = folder + "/leases/" + owner;
    const Fd file(open(path.c_str(), O_RDWR | O_CLOEXEC));
    if (!file || !lock_range(file.get(), 0, 1, false)) continue;
    inherit(owner);
    for_each_entry(folder + "/tmp", [&](const std::string& name) {
      if (name.starts_with(owner + "-")) unlink((folder + "/tmp/" + name).c_str());
    });
    unlink(path.c_str());
  }
}

}  // namespace engine::store
