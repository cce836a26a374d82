// SPDX-License-Identifier: Apache-2.0
#include "engine/store/foreign_journals.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <vector>

namespace engine::store {

bool ForeignJournals::refresh() {
  const std::lock_guard lock(mutex_);
  for (auto& [name, journal] : followed_) journal.seen = false;
  for_each_entry(folder_ + "/journals", [&](const std::string& name) {
    if (name.starts_with(own_)) return;
    auto found = followed_.find(name);
    if (found == followed_.end()) {
      found = followed_.try_emplace(name, folder_ + "/journals/" + name).first;
      if (!found->second.reader) {
        followed_.erase(found);
        return;
      }
    }
    found->second.seen = true;
    found->second.reader.read(found->second.entries);
  });
  return std::erase_if(followed_, [](const auto& item) { return !item.second.seen; }) > 0;
}

std::shared_ptr<const Entries::Record> ForeignJournals::record(const Digest& key) const {
  const std::lock_guard lock(mutex_);
  for (const auto& [name, journal] : followed_)
    if (const auto found = journal.entries.records.find(key); found != journal.entries.records.end())
      return found->second;
  return nullptr;
}

std::shared_ptr<const Bytes> ForeignJournals::value(const Digest& digest) const {
  const std::lock_guard lock(mutex_);
  for (const auto& [name, journal] : followed_)
    if (const auto found = journal.entries.values.find(digest); found != journal.entries.values.end())
      return found->second;
  return nullptr;
}

void inherit_journals(const std::string& folder, const std::string& owner,
                      const std::function<void(const Entries&)>& take) {
  std::vector<std::pair<std::uint64_t, std::string>> journals;
  for_each_entry(folder + "/journals", [&](const std::string& name) {
    if (!name.starts_with(owner + "-")) return;
    std::uint64_t number = 0;
    std::from_chars(name.data() + owner.size() + 1, name.data() + name.size(), number);
    journals.emplace_back(number, folder + "/journals/" + name);
  });
  std::sort(journals.begin(), journals.end());
  for (const auto& [number, path] : journals) {
    JournalReader reader(path);
    Entries entries;
    if (reader) reader.read(entries);
    if (!entries.empty()) take(entries);
    unlink(path.c_str());
  }
}

}  // namespace engine::store
