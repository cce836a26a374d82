// SPDX-License-Identifier: Apache-2.0
// Several stores on one folder: in one process, and in processes that end in every way.
#include "tests/engine/store/processes.h"

#include <chrono>
#include <thread>

#include "engine/store/journal.h"
#include "tests/engine/store/store_fixture.h"

namespace {

using engine::Bytes;
using engine::Digest;
using engine::Store;
using engine::TaskRecord;
using test::Child;
using test::digest_of_bytes;
using test::noise;
using test::record_of;
using TwoStores = test::StoreTest;
using KilledStore = test::StoreTest;
using KeyLocks = test::StoreTest;

std::size_t entries(const std::string& folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) count += entry.is_regular_file() ? 1 : 0;
  return count;
}

TEST_F(TwoStores, SeeWhatTheOtherPublishedAtOnce) {
  const auto a = open();
  const auto b = open();
  const TaskRecord record = record_of(1);
  EXPECT_FALSE(b->find_outputs(record.key));
  a->put(digest_of_bytes(noise(100)), noise(100));
  a->put(digest_of_bytes(noise(9'000)), noise(9'000));
  a->publish(record);
  const auto found = b->find(record.key);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->parts.size(), 2U);
  EXPECT_TRUE(b->find_outputs(record.key));
  EXPECT_EQ(b->get(digest_of_bytes(noise(100))), noise(100));
  EXPECT_TRUE(b->has(digest_of_bytes(noise(100))));
  EXPECT_EQ(b->get(digest_of_bytes(noise(9'000))), noise(9'000));
}

TEST_F(TwoStores, SeeWhatTheOtherFoldedMeanwhile) {
  const auto a = open();
  const auto b = open();
  a->publish(record_of(1));
  a->put(digest_of_bytes(noise(100)), noise(100));
  a->flush();
  EXPECT_TRUE(b->find(record_of(1).key));
  EXPECT_EQ(b->get(digest_of_bytes(noise(100))), noise(100));
  for (int i = 2; i < 200; ++i) {
    a->publish(record_of(i));
    if (i % 7 == 0) a->flush();
    EXPECT_TRUE(b->find_outputs(record_of(i).key)) << i;
    EXPECT_FALSE(b->find_outputs(record_of(i + 1).key)) << i;
  }
  EXPECT_EQ(b->stat().records, 199U - 199U % 7U);
}

TEST_F(TwoStores, LeaveNothingBehind) {
  {
    const auto a = open();
    const auto b = open();
    a->publish(record_of(1));
    b->publish(record_of(2));
    b->put(digest_of_bytes(noise(9'000)), noise(9'000));
  }
  EXPECT_EQ(entries(folder_ + "/journals"), 0U);
  EXPECT_EQ(entries(folder_ + "/leases"), 0U);
  EXPECT_EQ(entries(folder_ + "/tmp"), 0U);
  EXPECT_EQ(open()->stat().records, 2U);
}

TEST_F(TwoStores, ThatOpenTheSameNewFolderAtOnceBothWork) {
  for (int round = 0; round < 10; ++round) {
    folder_ = base_ + "/store" + std::to_string(round);
    std::vector<std::unique_ptr<Child>> children;
    for (int c = 0; c < 4; ++c)
      children.push_back(std::make_unique<Child>([&, c] {
        const auto store = open();
        store->publish(record_of(c));
      }));
    for (const auto& child : children) EXPECT_EQ(child->join(), 0);
    EXPECT_EQ(open()->stat().records, 4U);
  }
}

TEST_F(TwoStores, ManyProcessesPublishAndReadTogether) {
  constexpr int kChildren = 4;
  constexpr int kEach = 400;
  std::vector<std::unique_ptr<Child>> children;
  for (int c = 0; c < kChildren; ++c)
    children.push_back(std::make_unique<Child>([&, c] {
      const auto store = open();
      for (int i = 0; i < kEach; ++i) {
        // Half of the tasks are the same in all processes.
        const int number = i % 2 == 0 ? i : c * kEach + i;
        const TaskRecord record = record_of(number);
        const auto lock = store->try_lock(record.key);
        const Bytes value = noise(number % 20 == 0 ? 9'000 : 200, static_cast<unsigned>(number));
        if (lock && !store->find_outputs(record.key)) {
          store->put(digest_of_bytes(value), value);
          store->publish(record);
        }
        if (lock && !store->find_outputs(record.key)) throw std::runtime_error("a record is lost");
        if (lock && store->get(digest_of_bytes(value)) != value) throw std::runtime_error("a value is lost");
        if (i % 100 == c) store->flush();
      }
    }));
  for (const auto& child : children) EXPECT_EQ(child->join(), 0);
  const auto store = open();
  EXPECT_EQ(store->stat().records, static_cast<std::uint64_t>(kEach / 2 + kChildren * kEach / 2));
  EXPECT_TRUE(store->verify().damaged.empty());
}

TEST_F(KilledStore, LosesNoPublishedRecordAndGivesNoWrongHit) {
  for (int round = 0; round < 20; ++round) {
    const int first = round * 100'000;
    const std::string progress = base_ + "/progress";
    test::write(progress, std::string(8, '\0'));
    Child child([&] {
      const auto store = open();
      const int fd = ::open(progress.c_str(), O_WRONLY);
      Child::tell();
      for (std::int64_t i = 0;; ++i) {
        const int number = first + static_cast<int>(i);
        const Bytes value = noise(number % 10 == 0 ? 6'000 : 300, static_cast<unsigned>(number));
        TaskRecord record = record_of(number);
        record.outputs[0].elements[0].identity = digest_of_bytes(value);
        store->put(digest_of_bytes(value), value);
        store->publish(record);
        if (round % 3 == 0 && i % 40 == 0) store->flush();
        const std::int64_t done = i + 1;
        if (pwrite(fd, &done, sizeof done, 0) != sizeof done) throw std::runtime_error("no progress file");
      }
    });
    child.wait_told();
    std::this_thread::sleep_for(std::chrono::microseconds(1'000 + 2'711 * round));
    child.kill();
    std::int64_t done = 0;
    std::memcpy(&done, test::content(progress).data(), sizeof done);

    const auto store = open();
    EXPECT_EQ(entries(folder_ + "/tmp"), 0U);
    EXPECT_EQ(entries(folder_ + "/leases"), 1U);
    for (std::int64_t i = 0; i < done; ++i) {
      const int number = first + static_cast<int>(i);
      const auto found = store->find_outputs(record_of(number).key);
      ASSERT_TRUE(found) << "round " << round << ", " << i << " of " << done;
      const Bytes value = noise(number % 10 == 0 ? 6'000 : 300, static_cast<unsigned>(number));
      ASSERT_EQ(found->at(0).elements.at(0).identity, digest_of_bytes(value));
      ASSERT_EQ(store->get(digest_of_bytes(value)), value) << "round " << round << ", " << i << " of " << done;
    }
    // One more may have been published before the kill; nothing after it.
    EXPECT_FALSE(store->find_outputs(record_of(first + static_cast<int>(done) + 1).key));
    EXPECT_TRUE(store->take_damaged().empty());
  }
}

TEST_F(KilledStore, IsReadByStoresThatWereOpenBefore) {
  Child child([&] {
    Child::tell();
    Child::wait_for_go();
    const auto store = open();
    store->publish(record_of(1));
    Child::tell();
    Child::wait_for_go();
  });
  child.wait_told();
  const auto before = open();
  EXPECT_FALSE(before->find_outputs(record_of(1).key));
  child.go();
  child.wait_told();
  child.kill();
  EXPECT_TRUE(before->find_outputs(record_of(1).key));
  const auto after = open();  // folds the journal
  EXPECT_EQ(entries(folder_ + "/journals"), 0U);
  EXPECT_TRUE(before->find_outputs(record_of(1).key));
  EXPECT_TRUE(after->find_outputs(record_of(1).key));
}

TEST_F(KilledStore, ATornTailIsSkippedAndWhatStandsBeforeItKept) {
  for (const int cut : {1, 7, 8, 9, 40}) {
    Child child([&] {
      const auto store = open();
      for (int i = 0; i < 3; ++i) store->publish(record_of(cut * 10 + i));
      Child::tell();
      Child::wait_for_go();
    });
    child.wait_told();
    child.kill();
    std::string journal;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ + "/journals")) journal = entry.path();
    ASSERT_FALSE(journal.empty());
    std::filesystem::resize_file(journal, std::filesystem::file_size(journal) - static_cast<std::uintmax_t>(cut));
    const auto store = open();
    EXPECT_TRUE(store->find_outputs(record_of(cut * 10).key));
    EXPECT_TRUE(store->find_outputs(record_of(cut * 10 + 1).key));
    EXPECT_FALSE(store->find_outputs(record_of(cut * 10 + 2).key));
  }
}

TEST_F(KilledStore, AFrameWithAFlippedByteIsNotTakenIn) {
  Child child([&] {
    const auto store = open();
    for (int i = 0; i < 3; ++i) store->publish(record_of(i));
    Child::tell();
    Child::wait_for_go();
  });
  child.wait_told();
  child.kill();
  for (const auto& entry : std::filesystem::directory_iterator(folder_ + "/journals")) {
    std::string bytes = test::content(entry.path());
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
    test::write(entry.path(), bytes);
  }
  const auto store = open();
  const TaskRecord first = record_of(0);
  ASSERT_TRUE(store->find_outputs(first.key));
  EXPECT_TRUE(test::equal(*store->find_outputs(first.key), first.outputs));
  EXPECT_FALSE(store->find_outputs(record_of(1).key));
}

TEST_F(KeyLocks, ExcludeEachOtherWithinAStoreAndBetweenStores) {
  const auto a = open();
  const auto b = open();
  const Digest key = engine::digest_of("a task");
  auto held = a->try_lock(key);
  ASSERT_TRUE(held);
  EXPECT_FALSE(a->try_lock(key));
  EXPECT_FALSE(b->try_lock(key));
  EXPECT_TRUE(b->try_lock(engine::digest_of("another task")));
  held.reset();
  held = b->try_lock(key);
  ASSERT_TRUE(held);
  EXPECT_FALSE(a->try_lock(key));
  held.reset();
  EXPECT_TRUE(a->try_lock(key));
}

TEST_F(KeyLocks, EndWithTheProcess) {
  const Digest key = engine::digest_of("a task");
  Child child([&] {
    const auto store = open();
    const auto lock = store->try_lock(key);
    Child::tell();
    Child::wait_for_go();
  });
  child.wait_told();
  const auto store = open();
  EXPECT_FALSE(store->try_lock(key));
  child.kill();
  EXPECT_TRUE(store->try_lock(key));
}

TEST_F(KeyLocks, MayOutliveTheStore) {
  const Digest key = engine::digest_of("a task");
  auto store = open();
  auto lock = store->try_lock(key);
  store.reset();
  lock.reset();
  EXPECT_TRUE(open()->try_lock(key));
}

}  // namespace
