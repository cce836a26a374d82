// SPDX-License-Identifier: Apache-2.0
#include "engine/store/file_digests.h"

#include "engine/store/objects.h"
#include "tests/engine/store/store_fixture.h"

namespace {

using engine::digest_of;
using test::age;
using FileDigests = test::StoreTest;

TEST_F(FileDigests, AreThoseOfTheContent) {
  const auto store = open();
  const std::string path = base_ + "/line.txt";
  test::write(path, "hello");
  EXPECT_EQ(store->digest_file(path), digest_of("hello"));
  const std::string large(5'000'001, 'x');
  test::write(path, large);
  EXPECT_EQ(store->digest_file(path), digest_of(large));
  test::write(path, "");
  EXPECT_EQ(store->digest_file(path), digest_of(""));
}

TEST_F(FileDigests, AnUnreadableFileHasNone) {
  const auto store = open();
  EXPECT_FALSE(store->digest_file(base_ + "/absent.txt"));
  EXPECT_FALSE(store->digest_file(base_));
  EXPECT_FALSE(store->unchanged_since_digest(base_ + "/absent.txt"));
}

// A digest that was never that of the content shows whether it was remembered or computed.
TEST_F(FileDigests, AreRememberedUntilAnyPartOfTheStatDiffers) {
  open();
  const std::string path = base_ + "/line.txt";
  test::write(path, "hello");
  age(path, 1000);
  struct stat found;
  ASSERT_EQ(stat(path.c_str(), &found), 0);
  const engine::store::FileState state = engine::store::state_of(found);
  const auto digest_knowing = [&](const engine::store::FileState& known, bool folded) {
    engine::store::Index index(folder_);
    engine::store::Journal journal(folder_, "test");
    journal.add_file_digest(known, digest_of("remembered"));
    if (folded) {
      index.fold(*journal.seal(), {});
      journal.taken();
    }
    return *engine::store::FileDigests(index, journal).digest(path);
  };
  for (const bool folded : {false, true}) {
    SCOPED_TRACE(folded ? "in the index" : "in the journal");
    EXPECT_EQ(digest_knowing(state, folded), digest_of("remembered"));
    for (int part = 0; part < 5; ++part) {
      engine::store::FileState other = state;
      if (part == 0) ++other.size;
      if (part == 1) ++other.mtime_ns;
      if (part == 2) ++other.ctime_ns;
      if (part == 3) ++other.inode;
      if (part == 4) ++other.device;
      std::filesystem::remove(folder_ + "/index.sqlite");
      EXPECT_EQ(digest_knowing(other, folded), digest_of("hello")) << part;
    }
    std::filesystem::remove(folder_ + "/index.sqlite");
  }
}

TEST_F(FileDigests, OfOldFilesOutliveTheStore) {
  const std::string path = "/usr/include/stdio.h";  // a file that nobody changed within 2 s
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs " << path;
  open()->digest_file(path);
  struct stat found;
  ASSERT_EQ(stat(path.c_str(), &found), 0);
  engine::store::Index index(folder_);
  const auto known = index.file_digest(found.st_dev, found.st_ino);
  ASSERT_TRUE(known);
  EXPECT_EQ(known->digest, digest_of(test::content(path)));
}

TEST_F(FileDigests, OfAFileWrittenJustNowAreNotRemembered) {
  const auto store = open();
  const std::string path = base_ + "/line.txt";
  test::write(path, "one");
  EXPECT_EQ(store->digest_file(path), digest_of("one"));
  // Same size, same inode, and quite possibly the same times: they advance in steps of milliseconds.
  test::write(path, "two");
  EXPECT_EQ(store->digest_file(path), digest_of("two"));
}

TEST_F(FileDigests, ANewModificationTimeMakesItReadAgain) {
  const auto store = open();
  const std::string path = base_ + "/line.txt";
  test::write(path, "one");
  age(path, 1000);
  EXPECT_EQ(store->digest_file(path), digest_of("one"));
  test::write(path, "two");
  age(path, 1000);  // the change time still tells
  EXPECT_EQ(store->digest_file(path), digest_of("two"));
}

TEST_F(FileDigests, AnotherFileMovedIntoItsPlaceIsSeen) {
  const auto store = open();
  const std::string path = base_ + "/line.txt";
  test::write(path, "one");
  test::write(base_ + "/other.txt", "two");
  EXPECT_EQ(store->digest_file(path), digest_of("one"));
  EXPECT_TRUE(store->unchanged_since_digest(path));
  std::filesystem::rename(base_ + "/other.txt", path);
  EXPECT_FALSE(store->unchanged_since_digest(path));
  EXPECT_EQ(store->digest_file(path), digest_of("two"));
}

TEST_F(FileDigests, AFileCountsAsUnchangedUntilItsStatDiffers) {
  const auto store = open();
  const std::string path = base_ + "/line.txt";
  test::write(path, "one");
  EXPECT_FALSE(store->unchanged_since_digest(path));  // never digested
  store->digest_file(path);
  EXPECT_TRUE(store->unchanged_since_digest(path));
  test::write(path, "longer");
  EXPECT_FALSE(store->unchanged_since_digest(path));
  store->digest_file(path);
  EXPECT_TRUE(store->unchanged_since_digest(path));
  std::filesystem::remove(path);
  EXPECT_FALSE(store->unchanged_since_digest(path));
}

}  // namespace
