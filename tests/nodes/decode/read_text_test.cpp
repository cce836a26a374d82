// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_text.h"

#include "tests/nodes/decode/temporary.h"
#include "tests/support/expect_throw_text.h"

using face::decode::read_text;

namespace {

std::string read(const std::string& bytes) {
  const test::Temporary temporary;
  return read_text(engine::File::at(temporary.write("line.txt", bytes)));
}

}  // namespace

TEST(ReadText, TrimsWhiteSpaceAtBothEnds) { EXPECT_EQ(read(" \r\n\tbin blue at F2 now\r\n\n"), "bin blue at F2 now"); }
TEST(ReadText, KeepsLinesAndAccents) {
  EXPECT_EQ(read("caf\xC3\xA9\nna\xC3\xAFve \xF0\x9F\x98\x80"), "caf\xC3\xA9\nna\xC3\xAFve \xF0\x9F\x98\x80");
}
TEST(ReadText, DropsAByteOrderMark) { EXPECT_EQ(read("\xEF\xBB\xBFhello"), "hello"); }
TEST(ReadText, ConvertsUtf16OfEitherByteOrder) {
  EXPECT_EQ(read(std::string("\xFF\xFEh\0\xE9\0\x3D\xD8\x00\xDE", 10)), "h\xC3\xA9\xF0\x9F\x98\x80");
  EXPECT_EQ(read(std::string("\xFE\xFF\0h\0\xE9\xD8\x3D\xDE\x00", 10)), "h\xC3\xA9\xF0\x9F\x98\x80");
}
TEST(ReadText, ReadsTextThatANodeMadeInMemory) {
  EXPECT_EQ(read_text(engine::File::from_bytes("hello\n", ".txt")), "hello");
}
TEST(ReadText, RejectsAnEmptyText) {
  EXPECT_THROW_TEXT(read(""), "line.txt: is empty, expected a text");
  EXPECT_THROW_TEXT(read(" \n\n"), "line.txt: is empty, expected a text");
}
TEST(ReadText, RejectsBytesThatAreNotUtf8) {
  EXPECT_THROW_TEXT(read("one\ncaf\xE9 two"), "line.txt line 2: found byte 0xE9 at byte 7, expected UTF-8 text");
  EXPECT_THROW_TEXT(read("a\xC0\xAF"), "line.txt line 1: found byte 0xC0 at byte 1, expected UTF-8 text");  // overlong
  EXPECT_THROW_TEXT(read(std::string("a\0b", 3)), "line.txt line 1: found byte 0x00 at byte 1, expected UTF-8 text");
  EXPECT_THROW_TEXT(read(std::string("\xFF\xFEh\0\x3D\xD8", 6)), "line.txt byte 4: found half a UTF-16 surrogate pair");
}
TEST(ReadText, RejectsAMissingFileAndAFolder) {
  EXPECT_THROW_TEXT(read_text(engine::File::at("/nowhere/line.txt")),
                    "line.txt: cannot be opened: No such file or directory");
  const test::Temporary temporary;
  EXPECT_THROW_TEXT(read_text(engine::File::folder("/some/texts", {})), "texts: is a folder, expected a file");
}
