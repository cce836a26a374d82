// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "engine/base/bytes.h"
#include "engine/base/digest.h"
#include "engine/store/posix.h"

namespace engine::store {

// What stat says of a file: while it is equal, so (with the caution of FileDigests) is the content.
struct FileState {
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t mtime_ns = 0, ctime_ns = 0;
  bool operator==(const FileState&) const = default;
};

// What a journal holds, and what a fold takes into the index: encoded as in codec.h.
struct Entries {
  struct Record {
    Bytes outputs, details;
  };
  struct History {
    std::int64_t written_ns = 0;
    Bytes entries;
  };
  struct FileDigest {
    FileState state;
    Digest digest;
  };
  std::unordered_map<Digest, std::shared_ptr<const Record>> records;
  std::unordered_map<Digest, std::shared_ptr<const Bytes>> values;
  std::map<std::pair<std::string, std::string>, History> histories;            // by graph and node
  std::map<std::pair<std::uint64_t, std::uint64_t>, FileDigest> file_digests;  // by device and inode
  std::size_t bytes = 0;

  bool empty() const { return records.empty() && values.empty() && histories.empty() && file_digests.empty(); }
};

// This process's journals: append-only files of frames (length, CRC-32C, payload). Small values and notes wait in
// memory for the next record, and the record takes them along in one write(), so what is finished survives any end of
// the process but costs one system call. A journal is sealed, taken into the index and removed; later records go to a
// new one.
class Journal {
 public:
  // owner: name of this process's lease; the files are journals/OWNER-1, OWNER-2, ...
  Journal(std::string folder, std::string owner) : folder_(std::move(folder)), owner_(std::move(owner)) {}

  void add_record(const Digest& key, Entries::Record record);  // written when this returns
  void add_value(const Digest& digest, const Bytes& bytes);
  void add_history(const std::string& graph, const std::string& node, Entries::History history);
  void add_file_digest(const FileState& state, const Digest& digest);
  void write_waiting();

  std::shared_ptr<const Entries::Record> record(const Digest& key) const;
  std::shared_ptr<const Bytes> value(const Digest& digest) const;
  std::optional<Entries::History> history(const std::string& graph, const std::string& node) const;
  std::optional<Entries::FileDigest> file_digest(std::uint64_t device, std::uint64_t inode) const;

  // Whether the present journal file has so many records, or bytes.
  bool reaches(std::size_t records, std::size_t bytes) const;

  // Ends the present journal file and returns its entries (or those of the file sealed before and not yet taken); null
  // where there is nothing. After taken() they are no longer answered from here.
  std::shared_ptr<const Entries> seal();
  void taken();

 private:
  void append(const Bytes& frames);
  void write_locked(const Bytes* record_frame);
  std::string path(std::uint64_t number) const;

  const std::string folder_, owner_;
  mutable std::mutex mutex_;
  Fd file_;
  std::uint64_t size_ = 0, number_ = 0, sealed_number_ = 0;
  Bytes waiting_;
  std::shared_ptr<Entries> open_ = std::make_shared<Entries>(), sealed_;
};

// Reads a journal that its owner may be appending to: each call of read() takes in the whole frames that came since.
// Stops at a frame that is cut short or whose checksum is wrong, and tries it again at the next call: its owner may
// have taken a frame back that did not fit the disk.
class JournalReader {
 public:
  explicit JournalReader(const std::string& path);
  explicit operator bool() const { return static_cast<bool>(file_); }
  bool read(Entries& into);  // true when something new came

 private:
  Fd file_;
  std::uint64_t offset_ = 0;
};

}  // namespace engine::store
