// SPDX-License-Identifier: Apache-2.0
#include "engine/store/index.h"

#include <algorithm>
#include <memory>
#include <unordered_map>

#include "engine/base/problem.h"
#include "engine/store/codec.h"
#include "engine/store/posix.h"
#include "engine/store/sqlite.h"

namespace engine::store {
namespace {

constexpr int kFormat = 1;

// Keys are digests, so the rows that are read most lie in the tree of the key itself, where 75,000 fit the page cache.
// What only `explain` reads of a record stands apart, in a table that grows at its end: random inserts cost a page
// each.
constexpr const char* kSchema = R"(
CREATE TABLE meta(name TEXT PRIMARY KEY, value INTEGER) WITHOUT ROWID;
CREATE TABLE records(key BLOB PRIMARY KEY, outputs BLOB NOT NULL, details INTEGER NOT NULL) WITHOUT ROWID;
CREATE TABLE details(id INTEGER PRIMARY KEY, details BLOB NOT NULL);
CREATE TABLE small_values(digest BLOB PRIMARY KEY, bytes BLOB NOT NULL, used_ns INTEGER NOT NULL);
CREATE TABLE histories(graph TEXT, node TEXT, written_ns INTEGER NOT NULL, entries BLOB NOT NULL,
                       PRIMARY KEY(graph, node));
CREATE TABLE pins(name TEXT, digest BLOB, PRIMARY KEY(name, digest)) WITHOUT ROWID;
CREATE TABLE file_digests(device INTEGER, inode INTEGER, size INTEGER, mtime_ns INTEGER, ctime_ns INTEGER,
                          digest BLOB NOT NULL, PRIMARY KEY(device, inode)) WITHOUT ROWID;
)";

enum Statement {
  kOutputs,
  kRecord,
  kValue,
  kValueUsed,
  kHistory,
  kFileDigest,
  kPutDetails,
  kPutRecord,
  kPutValue,
  kUseValue,
  kPutHistory,
  kPutFileDigest,
  kPutPin,
  kDeletePins,
  kPins,
  kSmallValues,
  kDeleteValue,
  kRecordCount,
  kStatements
};

constexpr const char* kSql[kStatements] = {
    "SELECT outputs FROM records WHERE key = ?1",
    "SELECT outputs, (SELECT details FROM details WHERE id = records.details) FROM records WHERE key = ?1",
    "SELECT bytes, used_ns FROM small_values WHERE digest = ?1",
    "SELECT used_ns FROM small_values WHERE digest = ?1",
    "SELECT written_ns, entries FROM histories WHERE graph = ?1 AND node = ?2",
    "SELECT size, mtime_ns, ctime_ns, digest FROM file_digests WHERE device = ?1 AND inode = ?2",
    "INSERT INTO details(details) VALUES(?1)",
    "INSERT OR REPLACE INTO records VALUES(?1, ?2, ?3)",
    "INSERT INTO small_values VALUES(?1, ?2, ?3) ON CONFLICT(digest) DO UPDATE SET used_ns = excluded.used_ns",
    "UPDATE small_values SET used_ns = ?2 WHERE digest = ?1",
    "INSERT INTO histories VALUES(?1, ?2, ?3, ?4) ON CONFLICT(graph, node) DO UPDATE"
    " SET written_ns = excluded.written_ns, entries = excluded.entries WHERE excluded.written_ns >= written_ns",
    "INSERT OR REPLACE INTO file_digests VALUES(?1, ?2, ?3, ?4, ?5, ?6)",
    "INSERT OR IGNORE INTO pins VALUES(?1, ?2)",
    "DELETE FROM pins WHERE name = ?1",
    "SELECT name, digest FROM pins",
    "SELECT digest, length(bytes), used_ns FROM small_values",
    "DELETE FROM small_values WHERE digest = ?1",
    "SELECT count(*) FROM records",
};

}  // namespace

Index::Index(const std::string& folder) : folder_(folder), path_(folder + "/index.sqlite") {
  reader_ = std::make_unique<Connection>(folder_, path_, kSql);
  reader_->run("PRAGMA synchronous = NORMAL");
  if (reader_->number("SELECT count(*) FROM sqlite_master WHERE name = 'meta'") == 0) {
    reader_->run("PRAGMA journal_mode = WAL");
    Transaction transaction(*reader_);
    reader_->run(kSchema);
    reader_->run(("INSERT INTO meta VALUES('format', " + std::to_string(kFormat) + ")").c_str());
    transaction.commit();
  }
  const std::int64_t format = reader_->number("SELECT value FROM meta WHERE name = 'format'");
  if (format != kFormat)
    throw EngineError("the store in " + folder_ + " has format " + std::to_string(format) +
                      ", this program reads format " + std::to_string(kFormat) +
                      ": delete that folder, or choose another with --store");
  reader_->run("PRAGMA cache_size = -32768");
}

Index::~Index() = default;

Connection& Index::writer() {
  if (writer_ == nullptr) {
    writer_ = std::make_unique<Connection>(folder_, path_, kSql);
    // A power failure may cost the last batches, never the index: the write-ahead log is synced at checkpoints.
    writer_->run("PRAGMA synchronous = NORMAL");
    writer_->run("PRAGMA wal_autocheckpoint = 8000");
    writer_->run("PRAGMA cache_size = -16384");
  }
  return *writer_;
}

void Index::begin_reading() {
  read_lately_ = true;
  if (reading_ && !stale_.load(std::memory_order_acquire)) return;
  stale_.store(false, std::memory_order_release);
  if (reading_) reader_->run("COMMIT");
  reading_ = false;
  reader_->run("BEGIN");
  reading_ = true;
}

void Index::release_idle_snapshot() {
  const std::lock_guard lock(read_mutex_);
  if (reading_ && !read_lately_) {
    reader_->run("COMMIT");
    reading_ = false;
  }
  read_lately_ = false;
}

std::optional<std::vector<OutputRecord>> Index::outputs(const Digest& key) {
  const std::lock_guard lock(read_mutex_);
  begin_reading();
  Query query(*reader_, kOutputs);
  if (!query.bind(key).row()) return std::nullopt;
  return decode_outputs(query.blob(0));
}

std::optional<TaskRecord> Index::record(const Digest& key) {
  const std::lock_guard lock(read_mutex_);
  begin_reading();
  Query query(*reader_, kRecord);
  if (!query.bind(key).row()) return std::nullopt;
  TaskRecord record;
  record.key = key;
  record.outputs = decode_outputs(query.blob(0));
  decode_details(query.blob(1), record);
  return record;
}

std::optional<Index::Value> Index::value(const Digest& digest) {
  const std::lock_guard lock(read_mutex_);
  begin_reading();
  Query query(*reader_, kValue);
  if (!query.bind(digest).row()) return std::nullopt;
  return Value{query.bytes(0), query.number(1)};
}

std::optional<std::int64_t> Index::value_used_ns(const Digest& digest) {
  const std::lock_guard lock(read_mutex_);
  begin_reading();
  Query query(*reader_, kValueUsed);
  if (!query.bind(digest).row()) return std::nullopt;
  return query.number(0);
}

std::optional<Entries::History> Index::history(const std::string& graph, const std::string& node) {
  const std::lock_guard lock(read_mutex_);
  begin_reading();
  Query query(*reader_, kHistory);
  if (!query.bind(graph).bind(node).row()) return std::nullopt;
  return Entries::History{query.number(0), query.bytes(1)};
}

std::optional<Entries::FileDigest> Index::file_digest(std::uint64_t device, std::uint64_t inode) {
  const std::lock_guard lock(read_mutex_);
  begin_reading();
  Query query(*reader_, kFileDigest);
  if (!query.bind(device).bind(inode).row()) return std::nullopt;
  Entries::FileDigest found;
  found.state = {device, inode, static_cast<std::uint64_t>(query.number(0)), query.number(1), query.number(2)};
  found.digest = query.digest(3);
  return found;
}

namespace {

// In the order of the keys, which is that of the database's pages.
template <class Map>
std::vector<const typename Map::value_type*> by_key(const Map& map) {
  std::vector<const typename Map::value_type*> entries;
  entries.reserve(map.size());
  for (const auto& entry : map) entries.push_back(&entry);
  std::sort(entries.begin(), entries.end(), [](const auto* a, const auto* b) { return a->first < b->first; });
  return entries;
}

}  // namespace

void Index::fold(const Entries& entries, const std::unordered_set<Digest>& used) {
  const std::lock_guard lock(write_mutex_);
  Connection& connection = writer();
  Transaction transaction(connection);
  const std::int64_t now = now_ns();
  {
    Query details(connection, kPutDetails);
    Query records(connection, kPutRecord);
    for (const auto* entry : by_key(entries.records)) {
      details.bind(entry->second->details).run();
      const std::int64_t id = connection.last_row_id();
      records.bind(entry->first).bind(entry->second->outputs).bind(id).run();
    }
    Query values(connection, kPutValue);
    for (const auto* entry : by_key(entries.values)) values.bind(entry->first).bind(*entry->second).bind(now).run();
    Query use(connection, kUseValue);
    for (const Digest& digest : used) use.bind(digest).bind(now).run();
    Query histories(connection, kPutHistory);
    for (const auto& [name, history] : entries.histories)
      histories.bind(name.first).bind(name.second).bind(history.written_ns).bind(history.entries).run();
    Query files(connection, kPutFileDigest);
    for (const auto& [identity, file] : entries.file_digests)
      files.bind(identity.first)
          .bind(identity.second)
          .bind(file.state.size)
          .bind(file.state.mtime_ns)
          .bind(file.state.ctime_ns)
          .bind(file.digest)
          .run();
  }
  transaction.commit();
  renew();
}

void Index::pin(const std::string& name, const std::vector<Digest>& digests) {
  const std::lock_guard lock(write_mutex_);
  Connection& connection = writer();
  Transaction transaction(connection);
  {
    Query(connection, kDeletePins).bind(name).run();
    Query query(connection, kPutPin);
    for (const Digest& digest : digests) query.bind(name).bind(digest).run();
  }
  transaction.commit();
  renew();
}

void Index::unpin(const std::string& name) { pin(name, {}); }

Index::Pins Index::pins() {
  const std::lock_guard lock(write_mutex_);
  Pins pins;
  Query query(writer(), kPins);
  while (query.row()) {
    pins.names.insert(query.text(0));
    pins.digests.insert(query.digest(1));
  }
  return pins;
}

std::vector<Index::SmallValue> Index::small_values() {
  const std::lock_guard lock(write_mutex_);
  std::vector<SmallValue> found;
  Query query(writer(), kSmallValues);
  while (query.row()) found.push_back({query.digest(0), static_cast<std::uint64_t>(query.number(1)), query.number(2)});
  return found;
}

void Index::remove_values(const std::vector<Digest>& digests) {
  const std::lock_guard lock(write_mutex_);
  Connection& connection = writer();
  Transaction transaction(connection);
  {
    Query query(connection, kDeleteValue);
    for (const Digest& digest : digests) query.bind(digest).run();
  }
  transaction.commit();
  renew();
}

std::uint64_t Index::record_count() {
  const std::lock_guard lock(write_mutex_);
  Query query(writer(), kRecordCount);
  return query.row() ? static_cast<std::uint64_t>(query.number(0)) : 0;
}

}  // namespace engine::store
