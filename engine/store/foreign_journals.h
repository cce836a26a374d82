// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "engine/store/journal.h"

namespace engine::store {

// What other processes wrote to their journals and the index does not hold yet. Each journal is read on from where the
// last reading ended.
class ForeignJournals {
 public:
  ForeignJournals(std::string folder, std::string own) : folder_(std::move(folder)), own_(std::move(own)) {}

  // Reads the news. True when a journal has gone since: its entries are in the index now.
  bool refresh();
  std::shared_ptr<const Entries::Record> record(const Digest& key) const;
  std::shared_ptr<const Bytes> value(const Digest& digest) const;

 private:
  struct Followed {
    explicit Followed(const std::string& path) : reader(path) {}
    JournalReader reader;
    Entries entries;
    bool seen = false;
  };
  const std::string folder_, own_;
  mutable std::mutex mutex_;
  std::map<std::string, Followed> followed_;
};

// Reads the journals that a dead owner left, hands their entries to `take` in order and removes them.
void inherit_journals(const std::string& folder, const std::string& owner,
                      const std::function<void(const Entries&)>& take);

}  // namespace engine::store
