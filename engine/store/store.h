// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/bytes.h"
#include "engine/base/digest.h"

namespace engine {

// One output of a finished task. A single value has one element with an empty id; a sequence has its elements in order.
struct OutputRecord {
  struct Element {
    std::string id;
    Digest identity;  // content digest; of a cheap node: not stored (the identity follows from key and position)
  };
  bool sequence = false;
  std::vector<Element> elements;
  bool warned = false;  // of a task's first output: find() has warnings of the task
};

// What went into a key, kept so that a later rerun can be explained. At most about 1 KB a task.
struct KeyPart {
  std::string label;   // "parameter levels", "input frames", "plugin toy", "version"
  std::string value;   // parameters: as JSON; others: a digest in hex
  std::string origin;  // inputs: "node.output[17]" or the path of a file
};

struct TaskRecord {
  Digest key;
  std::vector<OutputRecord> outputs;
  std::vector<std::string> warnings;
  std::vector<KeyPart> parts;
  double seconds = 0;
};

// Which task stood behind each element of a node when a graph file last ran; for explain.
struct NodeHistory {
  struct Entry {
    std::string element;  // "", "17", "take03/17"
    Digest key;
  };
  std::vector<Entry> entries;
  std::vector<KeyPart> parts = {};  // version, plugin and parameters that all of them share
};

struct StoreStat {
  std::uint64_t objects = 0, object_bytes = 0, records = 0, small_values = 0, pins = 0;
};
struct GcResult {
  std::uint64_t removed_objects = 0, removed_bytes = 0, kept_bytes = 0;
};
struct VerifyResult {
  std::uint64_t checked = 0;
  std::vector<Digest> damaged;  // found damaged and removed
};

// The content-addressed store and its action index, shared by any number of processes (ARCHITECTURE section 6).
// All members may be called from several threads at once. Throws EngineError for a full disk or an unusable folder,
// naming folder and cause; a damaged object is never returned: it counts as missing.
class Store {
 public:
  // Opens or makes the store in a folder and takes a lease (a locked file that ends with the process).
  static std::shared_ptr<Store> open(const std::string& folder);
  virtual ~Store() = default;

  // Records. find() sees what this process published and what others' journals and index hold.
  virtual std::optional<TaskRecord> find(const Digest& key) = 0;
  // Only the outputs (the hot path of a rerun that does nothing): no parts, warnings or seconds.
  virtual std::optional<std::vector<OutputRecord>> find_outputs(const Digest& key) = 0;
  // Finished = the record was handed to the kernel. Its values must have been put before.
  virtual void publish(const TaskRecord& record) = 0;

  // Values by the digest of their uncompressed canonical bytes. Small ones go into the index, large ones become zstd
  // files.
  virtual void put(const Digest& digest, const Bytes& bytes) = 0;
  virtual std::optional<Bytes> get(const Digest& digest) = 0;
  virtual bool has(const Digest& digest) = 0;

  // File values: uncompressed, read-only, with their suffix. digest = SHA-256 of the content.
  virtual void put_file(const Digest& digest, const std::string& suffix, const Bytes& content) = 0;
  virtual void adopt_file(const Digest& digest, const std::string& suffix, const std::string& path) = 0;  // moves it
  virtual bool has_file(const Digest& digest, const std::string& suffix) = 0;
  // Path of the file in the store, verified against its digest once per process; empty when missing or damaged.
  virtual std::string file_path(const Digest& digest, const std::string& suffix) = 0;

  // Digest of a file outside the store, memoised by (device, inode, size, mtime, ctime); recomputed when in doubt.
  // nullopt where it cannot be read.
  virtual std::optional<Digest> digest_file(const std::string& path) = 0;
  // True when the file's stat still is what it was when digest_file() saw it last.
  virtual bool unchanged_since_digest(const std::string& path) = 0;

  // One process computes a key. Returns null where another one holds it: come back later, look in find() again after
  // getting it. The lock ends with the object, or with the process.
  class KeyLock {
   public:
    virtual ~KeyLock() = default;
  };
  virtual std::unique_ptr<KeyLock> try_lock(const Digest& key) = 0;

  // History for explain, by graph path and node id. Equal histories are not written again.
  virtual std::optional<NodeHistory> history(const std::string& graph, const std::string& node) = 0;
  virtual void set_history(const std::string& graph, const std::string& node, const NodeHistory& history) = 0;

  // Makes all that was published visible in the index (done in batches and at close anyway).
  virtual void flush() = 0;

  // Housekeeping.
  virtual StoreStat stat() = 0;
  virtual std::uint64_t object_bytes() = 0;  // of stat() alone: sizes of files, no look into the index
  // Removes the least recently used bytes until at most max_bytes are left and none is older than max_age_s (0 = any
  // age); never what is pinned or was written or read since the oldest live lease.
  virtual GcResult gc(std::uint64_t max_bytes, double max_age_s) = 0;
  virtual void pin(const std::string& name, const std::vector<Digest>& digests) = 0;
  virtual void unpin(const std::string& name) = 0;
  virtual VerifyResult verify() = 0;
  // Digests that get() and file_path() found damaged, and removed, since the last call: for a warning.
  virtual std::vector<Digest> take_damaged() = 0;
  virtual const std::string& folder() const = 0;
};

}  // namespace engine
