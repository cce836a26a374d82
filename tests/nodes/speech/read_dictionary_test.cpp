// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/read_dictionary.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/expect_throw_text.h"

namespace {

engine::File dictionary(const std::string& content) {
  const std::string path = testing::TempDir() + "/words.dict";
  std::ofstream(path, std::ios::binary) << content;
  return engine::File::at(path);
}

}  // namespace

using face::speech::read_dictionary;

TEST(ReadDictionary, CollectsTheVariantsOfTheWordsAskedFor) {
  const auto found = read_dictionary(
      dictionary(";;; note\nTHE  DH AH0\r\nTHE(2)  DH IY1\ncat K AE T # animal\ndog D AO G\n"), {"the", "cat", "bird"});
  EXPECT_EQ(found.size(), 2u);
  EXPECT_EQ(found.find("the")->second, (std::vector<std::string>{"DH AH", "DH IY"}));
  EXPECT_EQ(found.find("cat")->second, (std::vector<std::string>{"K AE T"}));
}

TEST(ReadDictionary, SaysWhereAFileIsWrong) {
  EXPECT_THROW_TEXT(read_dictionary(engine::File::at("/no/such.dict"), {}), "cannot open the dictionary /no/such.dict");
  EXPECT_THROW_TEXT(read_dictionary(dictionary(""), {}),
                    "the dictionary words.dict is empty: expected lines such as \"hello HH AH L OW\"");
  EXPECT_THROW_TEXT(read_dictionary(dictionary("a AH\nhello\n"), {}),
                    "words.dict:2: found \"hello\", expected a word and its phones");
  EXPECT_THROW_TEXT(read_dictionary(dictionary("a QQ\n"), {"a"}),
                    "words.dict:1: found the phone \"QQ\" in \"a\", expected one of the CMU dictionary's 39");
}
