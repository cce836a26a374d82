// SPDX-License-Identifier: Apache-2.0
#include "engine/store/store.h"

#include <atomic>
#include <thread>

#include "tests/engine/store/store_fixture.h"
#include "tests/support/expect_throw_text.h"

namespace {

using engine::Bytes;
using engine::Digest;
using engine::Store;
using engine::TaskRecord;
using test::bytes_of;
using test::digest_of_bytes;
using test::noise;
using test::record_of;
using StoreValues = test::StoreTest;
using StoreRecords = test::StoreTest;
using StoreFiles = test::StoreTest;
using StoreHistory = test::StoreTest;
using StoreDamage = test::StoreTest;

TEST_F(StoreValues, GivesBackWhatWasPutAtAnySize) {
  auto store = open();
  for (const std::size_t size : {0, 1, 4095, 4096, 4097, 100'000, 3'000'000}) {
    const Bytes bytes = noise(size);
    const Digest digest = digest_of_bytes(bytes);
    EXPECT_FALSE(store->has(digest));
    EXPECT_FALSE(store->get(digest));
    store->put(digest, bytes);
    EXPECT_TRUE(store->has(digest)) << size;
    EXPECT_EQ(store->get(digest), bytes) << size;
    store->flush();
    EXPECT_EQ(store->get(digest), bytes) << size;
  }
  store.reset();
  store = open();
  for (const std::size_t size : {0, 1, 4095, 4096, 4097, 100'000, 3'000'000})
    EXPECT_EQ(store->get(digest_of_bytes(noise(size))), noise(size)) << size;
}

TEST_F(StoreValues, UnpacksValuesThatCompressExtremely) {
  const auto store = open();
  const Bytes zeros(50'000'000);
  store->put(digest_of_bytes(zeros), zeros);
  EXPECT_EQ(store->get(digest_of_bytes(zeros)), zeros);
}

TEST_F(StoreRecords, FindsARecordWholeBeforeAndAfterItIsFolded) {
  auto store = open();
  TaskRecord record = record_of(1);
  record.outputs.push_back({true, {{"1", engine::digest_of("a")}, {"take03", engine::digest_of("b")}}});
  record.outputs.push_back({true, {}});
  EXPECT_FALSE(store->find(record.key));
  EXPECT_FALSE(store->find_outputs(record.key));
  store->publish(record);
  for (const char* when : {"at once", "folded", "opened again"}) {
    SCOPED_TRACE(when);
    if (when == std::string("folded")) store->flush();
    if (when == std::string("opened again")) {
      store.reset();
      store = open();
    }
    const auto found = store->find(record.key);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->key, record.key);
    EXPECT_TRUE(test::equal(found->outputs, record.outputs));
    EXPECT_EQ(found->warnings, record.warnings);
    ASSERT_EQ(found->parts.size(), 2U);
    EXPECT_EQ(found->parts[1].label, "input frames");
    EXPECT_EQ(found->parts[1].origin, "frames[17]");
    EXPECT_EQ(found->seconds, 0.25);
    const auto outputs = store->find_outputs(record.key);
    ASSERT_TRUE(outputs);
    EXPECT_TRUE(test::equal(*outputs, record.outputs));
  }
  EXPECT_FALSE(store->find(engine::digest_of("another task")));
}

TEST_F(StoreRecords, TheLastPublishedRecordOfAKeyCounts) {
  const auto store = open();
  TaskRecord record = record_of(1);
  store->publish(record);
  store->flush();
  record.outputs[0].elements[0].identity = engine::digest_of("recomputed");
  store->publish(record);
  EXPECT_TRUE(test::equal(*store->find_outputs(record.key), record.outputs));
  store->flush();
  EXPECT_TRUE(test::equal(*store->find_outputs(record.key), record.outputs));
  EXPECT_EQ(store->stat().records, 1U);
}

TEST_F(StoreRecords, SeveralThreadsPublishAndReadAtOnce) {
  auto store = open();
  constexpr int kThreads = 4;
  constexpr int kEach = 1500;
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < kEach; ++i) {
        const TaskRecord record = record_of(t * kEach + i);
        const Bytes value = noise(i % 50 == 0 ? 20'000 : 100, static_cast<unsigned>(i));
        store->put(digest_of_bytes(value), value);
        store->publish(record);
        const auto found = store->find_outputs(record.key);
        if (!found || !test::equal(*found, record.outputs)) ++wrong;
        if (store->get(digest_of_bytes(value)) != value) ++wrong;
        if (i % 500 == 0) store->flush();
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
  store.reset();
  store = open();
  EXPECT_EQ(store->stat().records, static_cast<std::uint64_t>(kThreads * kEach));
  for (int i = 0; i < kThreads * kEach; ++i) ASSERT_TRUE(store->find_outputs(record_of(i).key)) << i;
}

TEST_F(StoreFiles, AreReadOnlyWithTheirSuffixAndUncompressed) {
  const auto store = open();
  const Bytes bytes = bytes_of("glTF binary");
  const Digest digest = digest_of_bytes(bytes);
  EXPECT_EQ(store->file_path(digest, ".glb"), "");
  EXPECT_FALSE(store->has_file(digest, ".glb"));
  store->put_file(digest, ".glb", bytes);
  const std::string path = store->file_path(digest, ".glb");
  EXPECT_EQ(path, folder_ + "/files/" + digest.hex().substr(0, 2) + "/" + digest.hex().substr(2) + ".glb");
  EXPECT_EQ(test::content(path), "glTF binary");
  struct stat found;
  ASSERT_EQ(stat(path.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0222, 0U);
  EXPECT_TRUE(store->has_file(digest, ".glb"));
  EXPECT_FALSE(store->has_file(digest, ".bin"));
  EXPECT_EQ(store->file_path(digest, ".bin"), "");
}

TEST_F(StoreFiles, AnAdoptedFileIsMoved) {
  const auto store = open();
  const Digest digest = engine::digest_of("a film");
  for (int round = 0; round < 2; ++round) {
    const std::string path = base_ + "/scratch.mp4";
    test::write(path, "a film");
    store->adopt_file(digest, ".mp4", path);
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_EQ(test::content(store->file_path(digest, ".mp4")), "a film");
  }
}

TEST_F(StoreFiles, RejectsASuffixThatLeadsElsewhere) {
  const auto store = open();
  EXPECT_THROW_TEXT(store->put_file(engine::digest_of("x"), "/../x", bytes_of("x")),
                    "the suffix of a file is '/../x', expected a dot and a name");
}

TEST_F(StoreFiles, AChangedFileIsFoundRemovedAndReported) {
  const auto store = open();
  const Digest digest = engine::digest_of("good");
  store->put_file(digest, ".txt", bytes_of("good"));
  const std::string path = store->file_path(digest, ".txt");
  chmod(path.c_str(), 0644);
  test::write(path, "evil");
  EXPECT_EQ(store->file_path(digest, ".txt"), "");
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_EQ(store->take_damaged(), std::vector<Digest>{digest});
  EXPECT_TRUE(store->take_damaged().empty());
  store->put_file(digest, ".txt", bytes_of("good"));
  EXPECT_EQ(test::content(store->file_path(digest, ".txt")), "good");
}

TEST_F(StoreHistory, IsKeptByGraphAndNode) {
  auto store = open();
  EXPECT_FALSE(store->history("talk.json", "align"));
  const engine::NodeHistory history{{{"", engine::digest_of("a")}, {"take03/17", engine::digest_of("b")}}};
  store->set_history("talk.json", "align", history);
  store->set_history("talk.json", "render", {});
  for (int round = 0; round < 3; ++round) {
    const auto found = store->history("talk.json", "align");
    ASSERT_TRUE(found);
    ASSERT_EQ(found->entries.size(), 2U);
    EXPECT_EQ(found->entries[1].element, "take03/17");
    EXPECT_EQ(found->entries[1].key, engine::digest_of("b"));
    EXPECT_TRUE(store->history("talk.json", "render")->entries.empty());
    EXPECT_FALSE(store->history("other.json", "align"));
    if (round == 0) store->flush();
    if (round == 1) {
      store.reset();
      store = open();
    }
  }
}

TEST_F(StoreHistory, AnEqualOneIsNotWrittenAgain) {
  const auto store = open();
  const engine::NodeHistory history{{{"17", engine::digest_of("a")}}};
  store->set_history("talk.json", "align", history);
  store->flush();
  store->set_history("talk.json", "align", history);
  store->flush();
  EXPECT_TRUE(std::filesystem::is_empty(folder_ + "/journals"));
  store->set_history("talk.json", "align", {});
  EXPECT_TRUE(store->history("talk.json", "align")->entries.empty());
}

TEST_F(StoreDamage, AnyFlippedByteOfAnObjectIsFoundRemovedAndReported) {
  const auto store = open();
  const Bytes bytes = noise(9'000);
  const Digest digest = digest_of_bytes(bytes);
  const std::string path = test::object_path(folder_, digest);
  store->put(digest, bytes);
  const std::string good = test::content(path);
  int found = 0;
  // Every byte of the head, where sizes are, and some of the body.
  for (std::size_t at = 0; at < good.size(); at += at < 40 ? 1 : 97)
    for (const int flip : {0x01, 0x80}) {
      std::string bad = good;
      bad[at] = static_cast<char>(bad[at] ^ flip);
      store->put(digest, bytes);
      chmod(path.c_str(), 0644);
      test::write(path, bad);
      const auto got = store->get(digest);
      if (got) {
        EXPECT_EQ(*got, bytes) << at;  // a bit of the frame's head that means nothing
        std::filesystem::remove(path);
        continue;
      }
      ++found;
      EXPECT_FALSE(store->has(digest)) << at;
      EXPECT_EQ(store->take_damaged(), std::vector<Digest>{digest});
    }
  EXPECT_GT(found, 150);
}

TEST_F(StoreDamage, AFlippedByteOfTheIndexIsNoWrongHit) {
  TaskRecord record = record_of(1);
  record.outputs = {{true, {{"take03/17", engine::digest_of("a value")}}}};
  open()->publish(record);
  const Bytes small = bytes_of("a small value");
  open()->put(digest_of_bytes(small), small);
  const std::string index = folder_ + "/index.sqlite";
  const std::string good = test::content(index);
  const std::string identity(reinterpret_cast<const char*>(engine::digest_of("a value").bytes.data()), 32);
  for (const std::string& part : {std::string("take03/17"), identity, std::string("a small value")}) {
    std::string bad = good;
    const std::size_t at = bad.find(part);
    ASSERT_NE(at, std::string::npos);
    bad[at + 5] = static_cast<char>(bad[at + 5] ^ 1);
    test::write(index, bad);
    const auto store = open();
    if (part == "a small value") {
      EXPECT_FALSE(store->get(digest_of_bytes(small)));
      EXPECT_EQ(store->take_damaged(), std::vector<Digest>{digest_of_bytes(small)});
      EXPECT_FALSE(store->has(digest_of_bytes(small)));
    } else {
      EXPECT_FALSE(store->find_outputs(record.key));
      EXPECT_FALSE(store->find(record.key));
      store->publish(record);
      EXPECT_TRUE(store->find_outputs(record.key));
    }
  }
}

TEST_F(StoreDamage, AnObjectCutShortIsMissing) {
  const auto store = open();
  const Bytes bytes = noise(9'000);
  const Digest digest = digest_of_bytes(bytes);
  for (const int size : {0, 1, 5, 100, 3000}) {
    store->put(digest, bytes);
    std::filesystem::resize_file(test::object_path(folder_, digest), static_cast<std::uintmax_t>(size));
    EXPECT_FALSE(store->get(digest)) << size;
    EXPECT_FALSE(store->has(digest)) << size;
  }
}

TEST_F(StoreDamage, VerifyFindsAndRemovesWhatIsDamaged) {
  auto store = open();
  std::vector<Digest> digests;
  for (unsigned i = 0; i < 6; ++i) {
    const Bytes bytes = noise(i < 3 ? 9'000 : 50, i);
    digests.push_back(digest_of_bytes(bytes));
    store->put(digests.back(), bytes);
  }
  store->put_file(engine::digest_of("film"), ".mp4", bytes_of("film"));
  EXPECT_EQ(store->verify().checked, 7U);
  EXPECT_TRUE(store->verify().damaged.empty());
  std::filesystem::resize_file(test::object_path(folder_, digests[1]), 100);
  const auto result = store->verify();
  EXPECT_EQ(result.checked, 7U);
  EXPECT_EQ(result.damaged, std::vector<Digest>{digests[1]});
  EXPECT_FALSE(store->has(digests[1]));
  EXPECT_TRUE(store->has(digests[0]));
  EXPECT_EQ(store->verify().checked, 6U);
}

TEST_F(StoreRecords, StatCounts) {
  const auto store = open();
  EXPECT_EQ(store->stat().records, 0U);
  const Bytes large = noise(10'000);
  store->put(digest_of_bytes(large), large);
  store->put(digest_of_bytes(noise(10)), noise(10));
  store->put_file(engine::digest_of("film"), ".mp4", bytes_of("film"));
  store->publish(record_of(1));
  store->publish(record_of(2));
  store->pin("talk.json", {engine::digest_of("film")});
  const engine::StoreStat stat = store->stat();
  EXPECT_EQ(stat.objects, 2U);
  EXPECT_EQ(stat.records, 2U);
  EXPECT_EQ(stat.small_values, 1U);
  EXPECT_EQ(stat.pins, 1U);
  EXPECT_GT(stat.object_bytes, 4U);
  EXPECT_LT(stat.object_bytes, 10'000U);
}

}  // namespace
