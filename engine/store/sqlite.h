// SPDX-License-Identifier: Apache-2.0
// An SQLite database, as the store's index uses it. Not for several threads at once.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/store/store.h"

struct sqlite3;
struct sqlite3_stmt;

namespace engine::store {

// Opened, or made. What fails throws an EngineError that names the store's folder and says what to do.
class Connection {
 public:
  // sql: the statements that queries name by their place; they are prepared when first used, and must outlive this.
  Connection(const std::string& folder, const std::string& path, std::span<const char* const> sql);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void run(const char* sql);
  // What a query answers in its first row and column; 0 without a row.
  std::int64_t number(const char* sql);
  std::int64_t last_row_id() const;

 private:
  friend class Query;
  friend class Transaction;
  sqlite3_stmt* statement(std::size_t which);
  [[noreturn]] void fail() const;

  const std::string folder_, path_;
  const std::span<const char* const> sql_;
  sqlite3* handle_ = nullptr;
  std::vector<sqlite3_stmt*> statements_;
};

// One use of a prepared statement. Bound bytes are not copied: they must live as long as the query.
class Query {
 public:
  Query(Connection& connection, std::size_t which);
  ~Query();
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  // The next of the statement's parameters.
  Query& bind(const Digest& digest);
  Query& bind(const Bytes& bytes);
  Query& bind(const std::string& text);
  Query& bind(std::int64_t number);
  Query& bind(std::uint64_t number) { return bind(static_cast<std::int64_t>(number)); }

  // Goes on to the next row, if there is one.
  bool row();
  // Carries the statement out; then it can be bound anew.
  void run();

  std::span<const std::uint8_t> blob(int column) const;  // until the next row
  Bytes bytes(int column) const;
  Digest digest(int column) const;
  std::string text(int column) const;
  std::int64_t number(int column) const;

 private:
  Connection& connection_;
  sqlite3_stmt* const statement_;
  int bound_ = 0;
};

// A write transaction: rolled back unless committed.
class Transaction {
 public:
  explicit Transaction(Connection& connection);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Connection& connection_;
  bool open_ = true;
};

}  // namespace engine::store
