// SPDX-License-Identifier: Apache-2.0
// Lines, columns and pointers of a JSON document.
#include <gtest/gtest.h>

#include "engine/graph/json_tree.h"

namespace {

using engine::JsonMember;
using engine::JsonValue;
using engine::Problem;
using engine::SourceFile;

std::string listed(const JsonValue& value) {
  std::string text = value.pointer + "@" + std::to_string(value.line) + ":" + std::to_string(value.column) + " ";
  for (const JsonValue& item : value.items) text += listed(item);
  for (const JsonMember& member : value.members)
    text += std::to_string(member.line) + ":" + std::to_string(member.column) + "=" + listed(member.value);
  return text;
}

std::string positions(const std::string& text) {
  const SourceFile source{"x.json", "/", ""};
  JsonValue document;
  std::vector<Problem> problems;
  std::string out = engine::parse_json(text, source, document, problems) ? listed(document) : "";
  for (const Problem& problem : problems) out += problem.line() + "\n";
  return out;
}

TEST(JsonPositions, AreThoseOfTheFirstCharacter) {
  EXPECT_EQ(positions("{\"a\": 1,\n  \"b\": [true, null, \"x\", -1.5e3]}"),
            "@1:1 1:2=/a@1:7 2:3=/b@2:8 /b/0@2:9 /b/1@2:15 /b/2@2:21 /b/3@2:26 ");
}

TEST(JsonPositions, SkipCommentsWithQuotesAndBrackets) {
  EXPECT_EQ(positions("// \"a\": {\n/* [ \"*/ {/*x*/\"a\"/*:*/:/* 1 */2/*,*/,//}\n\"b\":3}"),
            "@2:10 2:16=/a@2:32 3:1=/b@3:5 ");
}

TEST(JsonPositions, FollowNumbersAtOnce) { EXPECT_EQ(positions("[1,22,[3]]"), "@1:1 /0@1:2 /1@1:4 /2@1:7 /2/0@1:8 "); }

TEST(JsonPositions, SurviveEscapedQuotesAndCountCharactersNotBytes) {
  EXPECT_EQ(positions("[\"a\\\"]\\\\\", \"\xC3\xA4\xE2\x82\xAC\", 1]"), "@1:1 /0@1:2 /1@1:12 /2@1:18 ");
}

TEST(JsonPositions, WorkWithWindowsLineEndsAndAByteOrderMark) {
  EXPECT_EQ(positions("\xEF\xBB\xBF{\r\n  \"a\": 1\r\n}"), "@1:1 2:3=/a@2:8 ");
}

TEST(JsonPositions, EscapeKeysInPointers) { EXPECT_EQ(positions("{\"a/b~c\": 1}"), "@1:1 1:2=/a~1b~0c@1:11 "); }

TEST(JsonPositions, OfDuplicatesAreThoseOfTheSecond) {
  EXPECT_EQ(positions("{\"a\": 1,\n\"a\": {\"b\": [2]},\n\"c\": 3}"),
            "@1:1 1:2=/a@1:7 3:1=/c@3:6 x.json:2:1: /a: the key \"a\" stands here twice; the first is in line 1\n");
}

TEST(JsonPositions, OfSyntaxErrorsAreThoseOfTheTokenThatDoesNotFit) {
  EXPECT_EQ(positions("{\n  \"a\": 1 /* here */ 2}"),
            "x.json:2:21: not valid JSON: unexpected number literal; expected '}' or a comma\n");
  EXPECT_EQ(positions("{\"a\": tru}"), "x.json:1:7: not valid JSON: invalid literal \"tru\"\n");
  EXPECT_EQ(positions("[1, 1e999]"), "x.json:1:5: not valid JSON: number overflow parsing '1e999'\n");
  EXPECT_EQ(positions("[1] 2"), "x.json:1:5: not valid JSON: unexpected number literal; expected end of input\n");
  EXPECT_EQ(positions("[1"), "x.json:1:3: not valid JSON: unexpected end of input; expected ']' or a comma\n");
  EXPECT_EQ(positions("[\"\xFF\"]"), "x.json:1:2: not valid JSON: invalid string: ill-formed UTF-8 byte\n");
}

TEST(JsonPositions, EndWhereNestingIsTooDeep) {
  EXPECT_EQ(positions(std::string(100000, '[')).substr(0, 12), "x.json:1:65:");
}

}  // namespace
