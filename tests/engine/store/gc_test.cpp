// SPDX-License-Identifier: Apache-2.0
#include "tests/engine/store/processes.h"
#include "tests/engine/store/store_fixture.h"

namespace {

using engine::Bytes;
using engine::Digest;
using engine::GcResult;
using engine::Store;
using test::age;
using test::Child;
using test::digest_of_bytes;
using test::noise;
using test::object_path;

class StoreGc : public test::StoreTest {
 protected:
  // Puts a large value that was used last so long ago. All take the same space, within a few bytes.
  Digest old_value(Store& store, unsigned seed, double age_s) const {
    const Bytes bytes = noise(10'000, seed);
    const Digest digest = digest_of_bytes(bytes);
    store.put(digest, bytes);
    age(object_path(folder_, digest), age_s);
    return digest;
  }
  bool there(const Digest& digest) const { return std::filesystem::exists(object_path(folder_, digest)); }
  // Returns when files that are made now are younger than all before: file times advance in steps of some milliseconds.
  void let_time_advance() const {
    const std::string probe = base_ + "/probe";
    timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    struct stat found;
    do {
      test::write(probe, "x");
      stat(probe.c_str(), &found);
    } while (found.st_mtim.tv_sec < now.tv_sec ||
             (found.st_mtim.tv_sec == now.tv_sec && found.st_mtim.tv_nsec <= now.tv_nsec));
  }
};

TEST_F(StoreGc, RemovesTheLeastRecentlyUsedUntilTheRestFits) {
  const auto store = open();
  const Digest oldest = old_value(*store, 1, 4000);
  const Digest older = old_value(*store, 2, 3000);
  const Digest newer = old_value(*store, 3, 2000);
  const auto size = std::filesystem::file_size(object_path(folder_, oldest));
  const GcResult result = store->gc(2 * size + size / 2, 0);
  EXPECT_FALSE(there(oldest));
  EXPECT_TRUE(there(older));
  EXPECT_TRUE(there(newer));
  EXPECT_EQ(result.removed_objects, 1U);
  EXPECT_EQ(result.removed_bytes, size);
  EXPECT_EQ(result.kept_bytes, std::filesystem::file_size(object_path(folder_, older)) +
                                   std::filesystem::file_size(object_path(folder_, newer)));
}

TEST_F(StoreGc, RemovesWhatIsTooOldEvenIfItFits) {
  const auto store = open();
  const Digest old = old_value(*store, 1, 4000);
  const Digest young = old_value(*store, 2, 1000);
  const GcResult result = store->gc(1'000'000'000, 2000);
  EXPECT_FALSE(there(old));
  EXPECT_TRUE(there(young));
  EXPECT_EQ(result.removed_objects, 1U);
}

TEST_F(StoreGc, NothingIsRemovedWhileAllFitsAndIsYoung) {
  const auto store = open();
  const Digest value = old_value(*store, 1, 4000);
  EXPECT_EQ(store->gc(1'000'000'000, 0).removed_objects, 0U);
  EXPECT_TRUE(there(value));
}

TEST_F(StoreGc, AReadSpares) {
  const auto store = open();
  const Digest read = old_value(*store, 1, 4000);
  const Digest asked = old_value(*store, 2, 4000);
  const Digest put = old_value(*store, 3, 4000);
  const Digest forgotten = old_value(*store, 4, 4000);
  EXPECT_TRUE(store->get(read));
  EXPECT_TRUE(store->has(asked));
  store->put(put, noise(10'000, 3));
  store->gc(0, 0);
  EXPECT_TRUE(there(read));
  EXPECT_TRUE(there(asked));
  EXPECT_TRUE(there(put));
  EXPECT_FALSE(there(forgotten));
  EXPECT_FALSE(store->has(forgotten));
  EXPECT_FALSE(store->get(forgotten));
}

TEST_F(StoreGc, FilesAreCollectedAndSparedLikeValues) {
  const auto store = open();
  const Digest used = engine::digest_of("used");
  const Digest unused = engine::digest_of("unused");
  store->put_file(used, ".txt", test::bytes_of("used"));
  store->put_file(unused, ".txt", test::bytes_of("unused"));
  const std::string used_path = store->file_path(used, ".txt");
  const std::string unused_path = store->file_path(unused, ".txt");
  age(used_path, 100);
  age(unused_path, 100);
  EXPECT_EQ(store->file_path(used, ".txt"), used_path);
  store->gc(0, 0);
  EXPECT_TRUE(std::filesystem::exists(used_path));
  EXPECT_FALSE(std::filesystem::exists(unused_path));
  EXPECT_EQ(store->file_path(unused, ".txt"), "");
}

TEST_F(StoreGc, PinsSpareValuesAndTheValuesOfPinnedTasks) {
  auto store = open();
  const Digest value = old_value(*store, 1, 4000);
  const Digest output = old_value(*store, 2, 4000);
  const Digest other = old_value(*store, 3, 4000);
  engine::TaskRecord record = test::record_of(1);
  record.outputs = {{true, {{"17", output}}}};
  store->publish(record);
  store->pin("talk.json", {value, record.key});
  store->gc(0, 0);
  EXPECT_TRUE(there(value));
  EXPECT_TRUE(there(output));
  EXPECT_FALSE(there(other));
  store.reset();
  store = open();
  EXPECT_EQ(store->gc(0, 0).removed_objects, 0U);
  store->unpin("talk.json");
  EXPECT_EQ(store->gc(0, 0).removed_objects, 2U);
  EXPECT_FALSE(there(value));
}

TEST_F(StoreGc, ASecondPinOfANameReplacesTheFirst) {
  const auto store = open();
  const Digest first = old_value(*store, 1, 4000);
  const Digest second = old_value(*store, 2, 4000);
  store->pin("talk.json", {first});
  store->pin("talk.json", {second});
  EXPECT_EQ(store->stat().pins, 1U);
  store->gc(0, 0);
  EXPECT_FALSE(there(first));
  EXPECT_TRUE(there(second));
}

TEST_F(StoreGc, RecordsStayWhenTheirBytesGo) {
  const auto store = open();
  const Digest value = old_value(*store, 1, 4000);
  engine::TaskRecord record = test::record_of(1);
  record.outputs[0].elements[0].identity = value;
  store->publish(record);
  store->gc(0, 0);
  EXPECT_FALSE(store->has(value));
  EXPECT_TRUE(store->find_outputs(record.key));
}

TEST_F(StoreGc, SmallValuesGoWhenUnusedAndStayWhenReadOrPinned) {
  auto store = open();
  for (unsigned i = 0; i < 4; ++i) store->put(digest_of_bytes(noise(300, i)), noise(300, i));
  store.reset();
  let_time_advance();
  store = open();
  EXPECT_TRUE(store->get(digest_of_bytes(noise(300, 0))));
  EXPECT_TRUE(store->has(digest_of_bytes(noise(300, 1))));
  store->pin("talk.json", {digest_of_bytes(noise(300, 2))});
  const GcResult result = store->gc(0, 0);
  EXPECT_EQ(result.removed_objects, 1U);
  EXPECT_EQ(result.removed_bytes, 300U);
  for (unsigned i = 0; i < 3; ++i) EXPECT_TRUE(store->has(digest_of_bytes(noise(300, i)))) << i;
  EXPECT_FALSE(store->has(digest_of_bytes(noise(300, 3))));
}

TEST_F(StoreGc, SparesWhatWasUsedSinceAnotherProcessOpenedTheStore) {
  // The other process opened the store an hour ago, by the time of its lease.
  Child child([&] {
    const auto store = open();
    for (const auto& lease : std::filesystem::directory_iterator(folder_ + "/leases")) age(lease.path(), 3600);
    Child::tell();
    Child::wait_for_go();
  });
  child.wait_told();
  const auto store = open();
  const Digest before = old_value(*store, 1, 4000);
  const Digest since = old_value(*store, 2, 3000);
  store->gc(0, 0);
  EXPECT_FALSE(there(before));
  EXPECT_TRUE(there(since));
  child.kill();
  store->gc(0, 0);
  EXPECT_FALSE(there(since));
}

TEST_F(StoreGc, RemovesTheTemporaryFilesOfDeadProcesses) {
  Child child([&] {
    const auto store = open();
    for (const auto& lease : std::filesystem::directory_iterator(folder_ + "/leases"))
      test::write(folder_ + "/tmp/" + lease.path().filename().string() + "-7", "half a value");
    Child::tell();
    Child::wait_for_go();
  });
  child.wait_told();
  {
    const auto store = open();
    store->gc(0, 0);
    EXPECT_FALSE(std::filesystem::is_empty(folder_ + "/tmp"));  // that process lives
  }
  child.kill();
  open()->gc(0, 0);
  EXPECT_TRUE(std::filesystem::is_empty(folder_ + "/tmp"));
}

}  // namespace
