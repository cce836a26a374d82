// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "engine/store/journal.h"
#include "engine/store/store.h"

namespace engine::store {

class Connection;

// The action index: an SQLite database in WAL mode. Reads go through one connection that keeps its snapshot until
// renew(); writes through another one, in batches. Throws EngineError.
class Index {
 public:
  struct Value {
    Bytes bytes;
    std::int64_t used_ns = 0;
  };

  // Opens or makes the database of a store. The caller holds the lock under which stores are made.
  explicit Index(const std::string& folder);
  ~Index();
  Index(const Index&) = delete;
  Index& operator=(const Index&) = delete;

  std::optional<std::vector<OutputRecord>> outputs(const Digest& key);
  std::optional<TaskRecord> record(const Digest& key);
  std::optional<Value> value(const Digest& digest);
  // Whether a small value is there, and when it was marked as used last.
  std::optional<std::int64_t> value_used_ns(const Digest& digest);
  std::optional<Entries::History> history(const std::string& graph, const std::string& node);
  std::optional<Entries::FileDigest> file_digest(std::uint64_t device, std::uint64_t inode);

  // The next read sees all that is committed by then.
  void renew() { stale_.store(true, std::memory_order_release); }
  // Ends a snapshot that nobody used since the last call: an old one would keep the write-ahead log growing.
  void release_idle_snapshot();

  // Takes a journal's entries in, and marks small values as used now, in one transaction.
  void fold(const Entries& entries, const std::unordered_set<Digest>& used);

  void pin(const std::string& name, const std::vector<Digest>& digests);
  void unpin(const std::string& name);
  struct Pins {
    std::unordered_set<std::string> names;
    std::unordered_set<Digest> digests;
  };
  Pins pins();

  struct SmallValue {
    Digest digest;
    std::uint64_t size = 0;
    std::int64_t used_ns = 0;
  };
  std::vector<SmallValue> small_values();
  void remove_values(const std::vector<Digest>& digests);
  std::uint64_t record_count();

 private:
  void begin_reading();
  Connection& writer();

  const std::string folder_, path_;
  std::mutex read_mutex_, write_mutex_;
  std::unique_ptr<Connection> reader_, writer_;
  std::atomic<bool> stale_{false};
  bool reading_ = false, read_lately_ = false;
};

}  // namespace engine::store
