// SPDX-License-Identifier: Apache-2.0
#include "engine/store/sqlite.h"

#include <sqlite3.h>

#include <cerrno>
#include <cstring>

#include "engine/base/problem.h"
#include "engine/store/posix.h"

namespace engine::store {

Connection::Connection(const std::string& folder, const std::string& path, std::span<const char* const> sql)
    : folder_(folder), path_(path), sql_(sql), statements_(sql.size()) {
  constexpr int busy_ms = 60'000;
  const int code = sqlite3_open_v2(path.c_str(), &handle_,
                                   SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr);
  if (code != SQLITE_OK) {
    try {
      fail();
    } catch (...) {
      sqlite3_close(handle_);
      throw;
    }
  }
  sqlite3_busy_timeout(handle_, busy_ms);
}

Connection::~Connection() {
  for (sqlite3_stmt* const statement : statements_) sqlite3_finalize(statement);
  sqlite3_close(handle_);
}

void Connection::run(const char* sql) {
  if (sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

std::int64_t Connection::number(const char* sql) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(handle_, sql, -1, &statement, nullptr) != SQLITE_OK) fail();
  const bool row = sqlite3_step(statement) == SQLITE_ROW;
  const std::int64_t value = row ? sqlite3_column_int64(statement, 0) : 0;
  if (sqlite3_finalize(statement) != SQLITE_OK) fail();
  return value;
}

std::int64_t Connection::last_row_id() const { return sqlite3_last_insert_rowid(handle_); }

sqlite3_stmt* Connection::statement(std::size_t which) {
  sqlite3_stmt*& prepared = statements_[which];
  if (prepared == nullptr &&
      sqlite3_prepare_v3(handle_, sql_[which], -1, SQLITE_PREPARE_PERSISTENT, &prepared, nullptr) != SQLITE_OK)
    fail();
  return prepared;
}

void Connection::fail() const {
  const int code = handle_ == nullptr ? SQLITE_NOMEM : sqlite3_errcode(handle_);
  const int system = handle_ == nullptr ? 0 : sqlite3_system_errno(handle_);
  switch (code & 0xff) {
    case SQLITE_FULL:
      fail_store(folder_, path_, ENOSPC);
    case SQLITE_READONLY:
      fail_store(folder_, path_, EACCES);
    case SQLITE_CANTOPEN:
      fail_store(folder_, path_, system != 0 ? system : EACCES);
    case SQLITE_IOERR:
      fail_store(folder_, path_, system != 0 ? system : EIO);
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      throw EngineError("the index of the store in " + folder_ + " is damaged (" + sqlite3_errmsg(handle_) + ": " +
                        path_ + "): delete that folder, or choose another with --store");
    case SQLITE_BUSY:
      throw EngineError("the index of the store in " + folder_ + " stays locked by another process (" + path_ +
                        "): end that process, or choose another folder with --store");
    default:
      throw EngineError("the index of the store in " + folder_ + " cannot be used (" +
                        (handle_ == nullptr ? "out of memory" : sqlite3_errmsg(handle_)) + ": " + path_ +
                        "): check that disk, or choose another folder with --store");
  }
}

Query::Query(Connection& connection, std::size_t which)
    : connection_(connection), statement_(connection.statement(which)) {}

Query::~Query() { sqlite3_reset(statement_); }

Query& Query::bind(const Digest& digest) {
  sqlite3_bind_blob(statement_, ++bound_, digest.bytes.data(), static_cast<int>(digest.bytes.size()), SQLITE_STATIC);
  return *this;
}

Query& Query::bind(const Bytes& bytes) {
  // A null pointer would bind NULL.
  sqlite3_bind_blob64(statement_, ++bound_, bytes.empty() ? static_cast<const void*>("") : bytes.data(), bytes.size(),
                      SQLITE_STATIC);
  return *this;
}

Query& Query::bind(const std::string& text) {
  sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_STATIC);
  return *this;
}

Query& Query::bind(std::int64_t number) {
  sqlite3_bind_int64(statement_, ++bound_, number);
  return *this;
}

bool Query::row() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) connection_.fail();
  return false;
}

void Query::run() {
  row();
  sqlite3_reset(statement_);
  bound_ = 0;
}

std::span<const std::uint8_t> Query::blob(int column) const {
  const void* const data = sqlite3_column_blob(statement_, column);
  return {static_cast<const std::uint8_t*>(data), static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

Bytes Query::bytes(int column) const {
  const auto found = blob(column);
  return {found.begin(), found.end()};
}

Digest Query::digest(int column) const {
  Digest value;
  const auto found = blob(column);
  if (found.size() == value.bytes.size()) std::memcpy(value.bytes.data(), found.data(), found.size());
  return value;
}

std::string Query::text(int column) const {
  const auto found = blob(column);
  return {found.begin(), found.end()};
}

std::int64_t Query::number(int column) const { return sqlite3_column_int64(statement_, column); }

Transaction::Transaction(Connection& connection) : connection_(connection) { connection_.run("BEGIN IMMEDIATE"); }

Transaction::~Transaction() {
  if (open_) sqlite3_exec(connection_.handle_, "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  connection_.run("COMMIT");
  open_ = false;
}

}  // namespace engine::store
