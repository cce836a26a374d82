// SPDX-License-Identifier: Apache-2.0
// A full disk, folders that cannot be used, and stores that this program cannot read.
#include <sys/mount.h>
#include <sys/resource.h>

#include "engine/base/problem.h"
#include "tests/engine/store/processes.h"
#include "tests/engine/store/store_fixture.h"
#include "tests/support/expect_throw_text.h"

namespace {

using engine::Bytes;
using engine::EngineError;
using engine::Store;
using test::Child;
using test::digest_of_bytes;
using test::noise;
using test::record_of;
using BadFolder = test::StoreTest;

TEST_F(BadFolder, AFileIsNoStore) {
  test::write(folder_, "a file");
  EXPECT_THROW_TEXT(open(), "the store in " + folder_ + " cannot be made (Not a directory: " + folder_ +
                                " is a file, expected a folder): choose another folder with --store");
  EXPECT_EQ(test::content(folder_), "a file");
  folder_ += "/below/it";
  EXPECT_THROW(open(), EngineError);
}

TEST_F(BadFolder, MissingParentsAreMade) {
  folder_ += "/a/b/c";
  open()->publish(record_of(1));
  EXPECT_TRUE(open()->find(record_of(1).key));
}

TEST_F(BadFolder, ARelativeFolderStaysWhereItWasWhenTheWorkingFolderChanges) {
  const std::string before = std::filesystem::current_path();
  std::filesystem::current_path(base_);
  const auto store = Store::open("./store/");
  std::filesystem::current_path("/");
  EXPECT_EQ(store->folder(), folder_);
  store->put_file(engine::digest_of("film"), ".mp4", test::bytes_of("film"));
  EXPECT_EQ(test::content(store->file_path(engine::digest_of("film"), ".mp4")), "film");
  std::filesystem::current_path(before);
}

TEST_F(BadFolder, AReadOnlyFolderIsNamed) {
  open()->publish(record_of(1));
  Child child([&] {
    // Nobody's rights: root may write anywhere.
    if (geteuid() == 0 && setresuid(65534, 65534, 65534) != 0) throw std::runtime_error("cannot drop rights");
    chmod(base_.c_str(), 0555);
    try {
      open();
    } catch (const EngineError& error) {
      if (std::string(error.what()).starts_with("the store in " + folder_ + " cannot be written (Permission denied: "))
        return;
      throw;
    }
    throw std::runtime_error("opened");
  });
  chmod(base_.c_str(), 0755);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(base_))
    if (entry.is_directory()) chmod(entry.path().c_str(), 0555);
  EXPECT_EQ(child.join(), 0);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(base_))
    if (entry.is_directory()) chmod(entry.path().c_str(), 0755);
}

TEST_F(BadFolder, AnIndexThatIsNoDatabaseIsNamed) {
  open()->publish(record_of(1));
  const std::string index = folder_ + "/index.sqlite";
  test::write(index, std::string(8192, 'x'));
  EXPECT_THROW_TEXT(open(), "the index of the store in " + folder_ + " is damaged (file is not a database: " + index +
                                "): delete that folder, or choose another with --store");
}

TEST_F(BadFolder, AnotherFormatIsNamed) {
  open()->publish(record_of(1));
  // The row of the format as the database holds it: a head of 3 bytes that gives the types (text of 6 bytes, the
  // constant 1), then the text. Type 8 is the constant 0.
  const std::string index = folder_ + "/index.sqlite";
  std::string bytes = test::content(index);
  const std::size_t at = bytes.find(
      "\x03\x19\x09"
      "format");
  ASSERT_NE(at, std::string::npos);
  bytes[at + 2] = 8;
  test::write(index, bytes);
  EXPECT_THROW_TEXT(open(), "the store in " + folder_ +
                                " has format 0, this program reads format 1: delete that folder, or choose "
                                "another with --store");
}

class FullDisk : public test::StoreTest {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(base_ + "/disk");
    mounted_ = mount("none", (base_ + "/disk").c_str(), "tmpfs", 0, "size=3m") == 0;
    if (!mounted_) GTEST_SKIP() << "needs the right to mount a small disk";
    folder_ = base_ + "/disk/store";
  }
  void TearDown() override {
    if (mounted_) umount2((base_ + "/disk").c_str(), MNT_DETACH);
  }
  bool mounted_ = false;
};

TEST_F(FullDisk, IsAnErrorThatSaysSoAndNothingIsDamaged) {
  auto store = open();
  int values = 0;
  int records = 0;
  std::string message;
  try {
    for (;; ++values) {
      const Bytes value = noise(100'000, static_cast<unsigned>(values));
      store->put(digest_of_bytes(value), value);
    }
  } catch (const EngineError& error) {
    message = error.what();
  }
  EXPECT_GT(values, 10);
  EXPECT_TRUE(message.starts_with("the store in " + folder_ + " is full (No space left on device: ")) << message;
  EXPECT_TRUE(message.ends_with("): free space on that disk, or choose another folder with --store")) << message;
  EXPECT_TRUE(std::filesystem::is_empty(folder_ + "/tmp"));
  EXPECT_FALSE(store->has(digest_of_bytes(noise(100'000, static_cast<unsigned>(values)))));

  message.clear();
  try {
    for (; records < 100'000; ++records) store->publish(record_of(records));
  } catch (const EngineError& error) {
    message = error.what();
  }
  EXPECT_TRUE(message.starts_with("the store in " + folder_ + " is full (No space left on device: ")) << message;
  EXPECT_THROW(store->publish(record_of(records)), EngineError);

  // With room again, it goes on, and all that was published before is there.
  std::filesystem::remove_all(folder_ + "/objects");
  store->publish(record_of(records));
  store.reset();
  store = open();
  for (int i = 0; i <= records; ++i) ASSERT_TRUE(store->find(record_of(i).key)) << i << " of " << records;
  EXPECT_TRUE(store->verify().damaged.empty());
}

TEST_F(FullDisk, WhenTheStoreClosesLosesNothing) {
  auto store = open();
  for (int i = 0; i < 300; ++i) store->publish(record_of(i));
  {
    std::ofstream ballast(base_ + "/disk/ballast", std::ios::binary);
    const std::string piece(4096, 'x');
    while (ballast << piece << std::flush) {
    }
  }
  store.reset();
  EXPECT_FALSE(std::filesystem::is_empty(folder_ + "/journals"));  // could not be folded
  std::filesystem::remove(base_ + "/disk/ballast");
  store = open();
  for (int i = 0; i < 300; ++i) ASSERT_TRUE(store->find(record_of(i).key)) << i;
  EXPECT_TRUE(std::filesystem::is_empty(folder_ + "/journals"));
}

TEST_F(FullDisk, CanBeCollected) {
  auto store = open();
  std::vector<engine::Digest> values;
  try {
    for (unsigned i = 0;; ++i) {
      const Bytes value = noise(100'000, i);
      store->put(digest_of_bytes(value), value);
      values.push_back(digest_of_bytes(value));
      test::age(test::object_path(folder_, values.back()), 1000);
    }
  } catch (const EngineError&) {
  }
  try {
    for (int i = 0;; ++i) store->publish(record_of(i));
  } catch (const EngineError&) {
  }
  EXPECT_GT(store->gc(0, 0).removed_objects, 0U);
  store->publish(record_of(1'000'000));
  store->flush();
  EXPECT_TRUE(store->find(record_of(1'000'000).key));
}

TEST_F(FullDisk, OfADeadProcessIsReadFromItsJournal) {
  Child child([&] {
    const auto store = open();
    for (int i = 0; i < 300; ++i) store->publish(record_of(i));
    Child::tell();
    Child::wait_for_go();
  });
  child.wait_told();
  child.kill();
  const std::string ballast = base_ + "/disk/ballast";
  {
    std::ofstream file(ballast, std::ios::binary);
    const std::string piece(4096, 'x');
    while (file << piece << std::flush) {
    }
  }
  std::filesystem::resize_file(ballast,
                               std::filesystem::file_size(ballast) - 60'000);  // enough to open, too little to fold
  const auto store = open();
  EXPECT_FALSE(std::filesystem::is_empty(folder_ + "/journals"));
  for (int i = 0; i < 300; ++i) ASSERT_TRUE(store->find(record_of(i).key)) << i;
}

TEST_F(BadFolder, ALimitOnTheSizeOfFilesIsAnErrorNotDamage) {
  Child child([&] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{200'000, 200'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    const auto store = open();
    bool refused = false;
    try {
      store->put(digest_of_bytes(noise(1'000'000)), noise(1'000'000));
    } catch (const EngineError&) {
      refused = true;
    }
    if (!refused) throw std::runtime_error("written beyond the limit");
    if (store->has(digest_of_bytes(noise(1'000'000)))) throw std::runtime_error("half a value counts");
    store->put(digest_of_bytes(noise(100'000)), noise(100'000));
  });
  EXPECT_EQ(child.join(), 0);
  const auto store = open();
  EXPECT_FALSE(store->has(digest_of_bytes(noise(1'000'000))));
  EXPECT_EQ(store->get(digest_of_bytes(noise(100'000))), noise(100'000));
}

}  // namespace
