// SPDX-License-Identifier: Apache-2.0
#include "engine/store/journal.h"

#include "engine/store/checksum.h"
#include "tests/engine/store/store_fixture.h"

namespace {

using engine::Bytes;
using engine::digest_of;
using engine::store::Entries;
using engine::store::Journal;
using engine::store::JournalReader;
using test::bytes_of;

class JournalTest : public test::StoreTest {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_ + "/journals"); }
  std::string file(int number) const { return folder_ + "/journals/me-" + std::to_string(number); }
};

TEST(Checksum, IsThatOfTheStandard) {
  EXPECT_EQ(engine::store::crc32c("123456789", 9), 0xe3069283U);  // the check value of CRC-32C (RFC 3720 uses it)
  EXPECT_EQ(engine::store::crc32c("", 0), 0U);
}

TEST_F(JournalTest, IsReadBackWhole) {
  Journal journal(folder_, "me");
  journal.add_value(digest_of("v"), bytes_of("v"));
  journal.add_history("talk.json", "align", {17, bytes_of("h")});
  journal.add_file_digest({1, 2, 3, 4, 5}, digest_of("f"));
  EXPECT_FALSE(std::filesystem::exists(file(1)));  // nothing is finished yet
  journal.add_record(digest_of("r"), {bytes_of("outputs"), bytes_of("details")});
  Entries entries;
  EXPECT_TRUE(JournalReader(file(1)).read(entries));
  EXPECT_EQ(*entries.values.at(digest_of("v")), bytes_of("v"));
  EXPECT_EQ((entries.histories.at({"talk.json", "align"}).entries), bytes_of("h"));
  EXPECT_EQ((entries.file_digests.at({1, 2}).state), (engine::store::FileState{1, 2, 3, 4, 5}));
  EXPECT_EQ((entries.file_digests.at({1, 2}).digest), digest_of("f"));
  EXPECT_EQ(entries.records.at(digest_of("r"))->outputs, bytes_of("outputs"));
  EXPECT_EQ(entries.records.at(digest_of("r"))->details, bytes_of("details"));
}

TEST_F(JournalTest, AReaderTakesWhatCameSinceItsLastReading) {
  Journal journal(folder_, "me");
  journal.add_record(digest_of("1"), {bytes_of("1"), {}});
  JournalReader reader(file(1));
  Entries entries;
  EXPECT_TRUE(reader.read(entries));
  EXPECT_FALSE(reader.read(entries));
  journal.add_record(digest_of("2"), {bytes_of("2"), {}});
  EXPECT_TRUE(reader.read(entries));
  EXPECT_EQ(entries.records.size(), 2U);
}

TEST_F(JournalTest, AFrameThatIsWrittenInPiecesIsTakenWhenItIsWhole) {
  {
    Journal journal(folder_, "me");
    journal.add_record(digest_of("1"), {bytes_of("first"), {}});
    journal.add_record(digest_of("2"), {bytes_of("second"), {}});
  }
  const std::string whole = test::content(file(1));
  const std::string path = folder_ + "/journals/other-1";
  test::write(path, "");
  JournalReader reader(path);
  Entries entries;
  for (std::size_t size = 1; size <= whole.size(); ++size) {
    test::write(path, whole.substr(0, size));
    reader.read(entries);
    EXPECT_EQ(entries.records.size(), size == whole.size() ? 2U : size >= 8 + (whole.size() - 9) / 2 ? 1U : 0U) << size;
  }
}

TEST_F(JournalTest, WhatIsSealedIsAnsweredUntilItIsTakenAndTheNextFileIsAnother) {
  Journal journal(folder_, "me");
  EXPECT_EQ(journal.seal(), nullptr);
  journal.add_record(digest_of("1"), {bytes_of("1"), {}});
  const auto sealed = journal.seal();
  ASSERT_NE(sealed, nullptr);
  journal.add_record(digest_of("2"), {bytes_of("2"), {}});
  EXPECT_TRUE(std::filesystem::exists(file(2)));
  EXPECT_TRUE(journal.record(digest_of("1")));
  EXPECT_EQ(journal.seal(), sealed);  // not taken yet
  journal.taken();
  EXPECT_FALSE(std::filesystem::exists(file(1)));
  EXPECT_FALSE(journal.record(digest_of("1")));
  EXPECT_TRUE(journal.record(digest_of("2")));
  EXPECT_EQ(journal.seal()->records.size(), 1U);
}

}  // namespace
