// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_set>
#include <vector>

#include "engine/base/digest.h"
#include "engine/store/posix.h"
#include "engine/store/store.h"

namespace engine::store {

// Locks of open file descriptions (F_OFD_SETLK): held by a store object, against threads of other stores in this
// process as well as other processes, and released by the kernel however the process ends.
bool lock_range(int fd, std::int64_t offset, std::int64_t length, bool wait);
void unlock_range(int fd, std::int64_t offset, std::int64_t length);
bool is_locked_elsewhere(int fd);

// The file `shared` of a store: its byte ranges are the locks of keys and of housekeeping, its first page counts what
// was written to journals, so that a miss costs other processes' news nothing while there are none.
class Shared {
 public:
  explicit Shared(const std::string& folder);
  ~Shared();
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;

  std::unique_ptr<Store::KeyLock> try_lock(const std::shared_ptr<Shared>& self, const Digest& key);
  bool holds(const Digest& key) const;

  // Held while a store is made or opened, and while one is collected: waits for the other.
  class Section {
   public:
    Section(Shared& shared, std::int64_t offset);
    ~Section();
    Section(const Section&) = delete;
    Section& operator=(const Section&) = delete;

   private:
    Fd file_;  // of its own: an open file description does not lock against itself
    std::int64_t offset_;
  };
  static constexpr std::int64_t kOpening = std::int64_t{1} << 62;
  static constexpr std::int64_t kCollecting = kOpening + 1;

  // Tells others that there is news, and whether others told.
  void announce();
  std::uint64_t news_of_others() const;

 private:
  class Held;
  const std::string folder_, path_;
  Fd file_;
  std::atomic<std::uint64_t>* counter_ = nullptr;
  std::atomic<std::uint64_t> own_{0};
  mutable std::mutex mutex_;
  std::unordered_set<std::int64_t> held_;
};

// A locked file leases/OWNER for as long as a store is open. Its modification time is when that began, by the clock
// that stamps the store's files. Whoever finds it unlocked knows that the owner is gone, and takes in its journals.
class Lease {
 public:
  explicit Lease(const std::string& folder);
  const std::string& owner() const { return owner_; }
  std::int64_t start_ns() const { return start_ns_; }
  void end();  // removes it

 private:
  std::string path_, owner_;
  std::int64_t start_ns_ = 0;
  Fd file_;
};

struct OtherLease {
  std::string owner;
  std::int64_t start_ns = 0;
};
std::vector<OtherLease> live_leases(const std::string& folder, const std::string& except);

// Calls `inherit` for the owner of every lease that nobody holds, then removes the lease and what that owner left in
// tmp/.
void visit_dead_leases(const std::string& folder, const std::function<void(const std::string& owner)>& inherit);

}  // namespace engine::store
