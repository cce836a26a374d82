// SPDX-License-Identifier: Apache-2.0
#include "engine/store/store.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <shared_mutex>
#include <thread>
#include <unordered_set>

#include "engine/base/problem.h"
#include "engine/store/codec.h"
#include "engine/store/file_digests.h"
#include "engine/store/foreign_journals.h"
#include "engine/store/gc.h"
#include "engine/store/index.h"
#include "engine/store/journal.h"
#include "engine/store/locks.h"
#include "engine/store/objects.h"
#include "engine/store/posix.h"

namespace engine {
namespace store {
namespace {

constexpr std::size_t kSmallBytes = 4096;  // values up to here lie in the index
// A journal is folded when it has so many records or bytes, or is this old. Larger batches rewrite fewer pages of the
// index.
constexpr std::size_t kFoldRecords = 8000;
constexpr std::size_t kFoldBytes = 24 << 20;
constexpr std::chrono::milliseconds kFoldWait{1000};

// Makes the folders. The path is absolute from here on: the working directory may change.
std::string prepared(const std::string& given) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(given, error).lexically_normal();
  std::string folder = error ? given : absolute.string();
  while (folder.size() > 1 && folder.back() == '/') folder.pop_back();
  for (const char* part : {"", "/journals", "/leases", "/tmp", "/objects", "/files"})
    make_folder(folder, folder + part);
  return folder;
}

class FolderStore final : public Store {
 public:
  explicit FolderStore(const std::string& given)
      : folder_(prepared(given)),
        shared_(std::make_shared<Shared>(folder_)),
        index_(open_index()),
        lease_(folder_),
        journal_(folder_, lease_.owner()),
        foreign_(folder_, lease_.owner()),
        objects_(folder_, lease_.owner(), lease_.start_ns()),
        file_digests_(*index_, journal_) {
    try {
      fold_dead();
    } catch (const EngineError&) {
      // The disk is full, say. What dead owners left is read from their journals, and folded another time.
    }
    folder_thread_ = std::thread([this] { fold_in_background(); });
  }

  ~FolderStore() override {
    {
      const std::lock_guard lock(wake_mutex_);
      closing_ = true;
    }
    wake_.notify_all();
    folder_thread_.join();
    try {
      fold();
      lease_.end();
    } catch (const std::exception&) {
      // The journals stay, under a lease that nobody holds: whoever opens the store next takes them in.
    }
  }

  std::optional<TaskRecord> find(const Digest& key) override {
    return look_twice<TaskRecord>(
        key,
        [&](const Entries::Record& found) {
          TaskRecord record;
          record.key = key;
          record.outputs = decode_outputs(found.outputs);
          decode_details(found.details, record);
          return record;
        },
        [&] { return index_->record(key); });
  }

  std::optional<std::vector<OutputRecord>> find_outputs(const Digest& key) override {
    return look_twice<std::vector<OutputRecord>>(
        key, [](const Entries::Record& found) { return decode_outputs(found.outputs); },
        [&] { return index_->outputs(key); });
  }

  void publish(const TaskRecord& record) override {
    journal_.add_record(record.key, {encode_outputs(record.outputs), encode_details(record)});
    shared_->announce();
    wake_folder();
  }

  void put(const Digest& digest, const Bytes& bytes) override {
    if (bytes.size() > kSmallBytes) return objects_.put(digest, bytes);
    if (has_small(digest)) return;
    journal_.add_value(digest, bytes);
    wake_folder();
  }

  std::optional<Bytes> get(const Digest& digest) override {
    for (const bool again : {false, true}) {
      if (again && !refresh(false)) break;
      if (const auto found = journal_.value(digest)) return *found;
      if (const auto found = foreign_.value(digest)) return *found;
      if (auto found = index_->value(digest)) {
        if (digest_of(std::span<const std::uint8_t>(found->bytes)) == digest) {
          mark_used(digest, found->used_ns);
          return std::move(found->bytes);
        }
        index_->remove_values({digest});
        note_damaged(digest);
        continue;
      }
      Bytes bytes;
      switch (objects_.get(digest, bytes)) {
        case Objects::Found::yes:
          return bytes;
        case Objects::Found::damaged:
          note_damaged(digest);
          break;
        case Objects::Found::no:
          break;
      }
    }
    return std::nullopt;
  }

  bool has(const Digest& digest) override {
    if (has_small(digest) || objects_.has(digest)) return true;
    return refresh(false) && (has_small(digest) || objects_.has(digest));
  }

  void put_file(const Digest& digest, const std::string& suffix, const Bytes& content) override {
    objects_.put_file(digest, suffix, content);
  }
  void adopt_file(const Digest& digest, const std::string& suffix, const std::string& path) override {
    objects_.adopt_file(digest, suffix, path);
  }
  bool has_file(const Digest& digest, const std::string& suffix) override { return objects_.has_file(digest, suffix); }
  std::string file_path(const Digest& digest, const std::string& suffix) override {
    std::string path;
    if (objects_.check_file(digest, suffix, path) == Objects::Found::damaged) note_damaged(digest);
    return path;
  }

  std::optional<Digest> digest_file(const std::string& path) override { return file_digests_.digest(path); }
  bool unchanged_since_digest(const std::string& path) override { return file_digests_.unchanged(path); }

  std::unique_ptr<KeyLock> try_lock(const Digest& key) override { return shared_->try_lock(shared_, key); }

  std::optional<NodeHistory> history(const std::string& graph, const std::string& node) override {
    std::optional<Entries::History> found = journal_.history(graph, node);
    if (!found) found = index_->history(graph, node);
    if (!found) return std::nullopt;
    try {
      return decode_history(found->entries);
    } catch (const std::runtime_error&) {
      return std::nullopt;
    }
  }

  void set_history(const std::string& graph, const std::string& node, const NodeHistory& history) override {
    Bytes entries = encode_history(history);
    std::optional<Entries::History> found = journal_.history(graph, node);
    if (!found) found = index_->history(graph, node);
    if (found && found->entries == entries) return;
    journal_.add_history(graph, node, {now_ns(), std::move(entries)});
    wake_folder();
  }

  void flush() override {
    fold();
    fold_dead();
  }

  std::uint64_t object_bytes() override {
    std::uint64_t bytes = 0;
    objects_.for_each([&](const Objects::Item& item) { bytes += item.size; });
    return bytes;
  }

  StoreStat stat() override {
    flush();
    StoreStat result;
    objects_.for_each([&](const Objects::Item&) { ++result.objects; });
    result.object_bytes = object_bytes();
    result.records = index_->record_count();
    result.small_values = index_->small_values().size();
    result.pins = index_->pins().names.size();
    return result;
  }

  GcResult gc(std::uint64_t max_bytes, double max_age_s) override {
    const Shared::Section section(*shared_, Shared::kCollecting);
    try {
      flush();
    } catch (const EngineError&) {
      // A full disk cannot take the index's news, but collecting makes room.
    }
    refresh(true);
    GcLimits limits{max_bytes, max_age_s, lease_.start_ns(), false};
    for (const OtherLease& lease : live_leases(folder_, lease_.owner())) {
      limits.spare_ns = std::min(limits.spare_ns, lease.start_ns);
      limits.spare_small_values = true;
    }
    // A pinned key stands for the values of its record.
    std::unordered_set<Digest> pinned;
    for (const Digest& digest : index_->pins().digests) {
      pinned.insert(digest);
      if (const auto outputs = find_outputs(digest))
        for (const OutputRecord& output : *outputs)
          for (const OutputRecord::Element& element : output.elements) pinned.insert(element.identity);
    }
    return collect(*index_, objects_, pinned, limits);
  }

  void pin(const std::string& name, const std::vector<Digest>& digests) override { index_->pin(name, digests); }
  void unpin(const std::string& name) override { index_->unpin(name); }

  VerifyResult verify() override {
    flush();
    VerifyResult result;
    const auto count = [&](Objects::Found found, const Digest& digest) {
      if (found != Objects::Found::no) ++result.checked;
      if (found == Objects::Found::damaged) result.damaged.push_back(digest);
    };
    objects_.for_each([&](const Objects::Item& item) { count(objects_.check(item), item.digest); });
    std::vector<Digest> damaged;
    for (const Index::SmallValue& value : index_->small_values()) {
      const auto found = index_->value(value.digest);
      if (!found) continue;
      const bool good = digest_of(std::span<const std::uint8_t>(found->bytes)) == value.digest;
      if (!good) damaged.push_back(value.digest);
      count(good ? Objects::Found::yes : Objects::Found::damaged, value.digest);
    }
    if (!damaged.empty()) index_->remove_values(damaged);
    return result;
  }

  std::vector<Digest> take_damaged() override {
    const std::lock_guard lock(notes_mutex_);
    return std::exchange(damaged_, {});
  }

  const std::string& folder() const override { return folder_; }

 private:
  std::unique_ptr<Index> open_index() {
    const Shared::Section section(*shared_, Shared::kOpening);
    return std::make_unique<Index>(folder_);
  }

  // Looks in this process's journal, in those of others and in the index; and once more after reading the news, when
  // there is any. Under the key's lock the news is read in any case: another process may have died between writing its
  // record and telling of it.
  template <class Result, class Decode, class Ask>
  std::optional<Result> look_twice(const Digest& key, const Decode& decode, const Ask& ask) {
    for (const bool again : {false, true}) {
      if (again && !refresh(shared_->holds(key))) break;
      try {
        if (const auto found = journal_.record(key)) return decode(*found);
        if (const auto found = foreign_.record(key)) return decode(*found);
        if (auto found = ask()) return found;
      } catch (const EngineError&) {
        throw;
      } catch (const std::runtime_error&) {
        break;  // a row whose bytes do not decode counts as missing
      }
    }
    return std::nullopt;
  }

  // Reads what other processes published since the last time. False where there is nothing new.
  bool refresh(bool always) {
    const std::uint64_t news = shared_->news_of_others();
    if (!always && news == seen_news_.load(std::memory_order_acquire)) return false;
    // Journals first: what leaves them meanwhile is in the index that is looked at afterwards.
    foreign_.refresh();
    index_->renew();
    seen_news_.store(news, std::memory_order_release);
    return true;
  }

  bool has_small(const Digest& digest) {
    if (journal_.value(digest) || foreign_.value(digest)) return true;
    const std::optional<std::int64_t> used_ns = index_->value_used_ns(digest);
    if (used_ns) mark_used(digest, *used_ns);
    return used_ns.has_value();
  }

  void mark_used(const Digest& digest, std::int64_t used_ns) {
    if (used_ns >= lease_.start_ns()) return;
    const std::lock_guard lock(notes_mutex_);
    used_.insert(digest);
  }

  void note_damaged(const Digest& digest) {
    const std::lock_guard lock(notes_mutex_);
    damaged_.push_back(digest);
  }

  void fold() {
    const std::lock_guard lock(fold_mutex_);
    // A journal sealed before (its fold failed) comes first, then the present one.
    for (int round = 0; round < 2; ++round) {
      const std::shared_ptr<const Entries> sealed = journal_.seal();
      std::unordered_set<Digest> used;
      {
        const std::lock_guard notes(notes_mutex_);
        used.swap(used_);
      }
      if (sealed == nullptr && used.empty()) return;
      try {
        static const Entries none;
        index_->fold(sealed ? *sealed : none, used);
      } catch (...) {
        const std::lock_guard notes(notes_mutex_);
        used_.merge(used);
        throw;
      }
      if (sealed == nullptr) return;
      journal_.taken();
      shared_->announce();
    }
  }

  void fold_dead() {
    visit_dead_leases(folder_, [this](const std::string& owner) {
      inherit_journals(folder_, owner, [this](const Entries& entries) { index_->fold(entries, {}); });
    });
  }

  void wake_folder() {
    if (waiting_.exchange(true, std::memory_order_acq_rel)) {
      if (!journal_.reaches(kFoldRecords, kFoldBytes)) return;
      if (full_.exchange(true, std::memory_order_acq_rel)) return;
    }
    { const std::lock_guard lock(wake_mutex_); }
    wake_.notify_one();
  }

  void fold_in_background() {
    std::unique_lock lock(wake_mutex_);
    while (!closing_) {
      if (!waiting_.load(std::memory_order_acquire)) {
        wake_.wait_for(lock, std::chrono::seconds(1), [this] { return closing_ || waiting_.load(); });
        lock.unlock();
        index_->release_idle_snapshot();
        lock.lock();
        continue;
      }
      wake_.wait_for(lock, kFoldWait, [this] { return closing_ || full_.load(); });
      if (closing_) return;
      lock.unlock();
      waiting_.store(false);
      full_.store(false);
      try {
        fold();
      } catch (const std::exception&) {
        waiting_.store(true);  // tried again; flush() says what is wrong
      }
      index_->release_idle_snapshot();
      lock.lock();
    }
  }

  const std::string folder_;
  const std::shared_ptr<Shared> shared_;
  const std::unique_ptr<Index> index_;
  Lease lease_;
  Journal journal_;
  ForeignJournals foreign_;
  Objects objects_;
  FileDigests file_digests_;
  std::atomic<std::uint64_t> seen_news_{~std::uint64_t{0}};

  std::mutex notes_mutex_;
  std::unordered_set<Digest> used_;
  std::vector<Digest> damaged_;

  std::mutex fold_mutex_, wake_mutex_;
  std::condition_variable wake_;
  std::atomic<bool> waiting_{false}, full_{false};
  bool closing_ = false;
  std::thread folder_thread_;
};

}  // namespace
}  // namespace store

std::shared_ptr<Store> Store::open(const std::string& folder) { return std::make_shared<store::FolderStore>(folder); }

}  // namespace engine
