// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/read_visemes.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "nodes/types/arkit.h"
#include "tests/support/expect_throw_text.h"

namespace face::trajectory {
namespace {

const std::string table_path = std::string(FACEGRAPH_SOURCE_DIR) + "/graphs/speech/visemes.json";

std::string table_text() {
  std::ifstream file(table_path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The project's table with one piece of its text replaced.
engine::File edited(const std::string& from, const std::string& to) {
  std::string text = table_text();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  return engine::File::from_bytes(text, ".json");
}

const Viseme& entry(const Visemes& visemes, const std::string& label) {
  for (const Viseme& viseme : visemes.visemes)
    if (viseme.label == label) return viseme;
  throw std::runtime_error("no " + label);
}

float weight(const Viseme& viseme, std::string_view name) { return viseme.weights[arkit_index(name)]; }

TEST(ReadVisemes, ReadsTheProjectsTable) {
  const Visemes visemes = read_visemes(engine::File::at(table_path));
  EXPECT_EQ(visemes.visemes.size(), 52u);
  for (const Viseme& viseme : visemes.visemes) {
    ASSERT_EQ(viseme.weights.size(), arkit_count);
    ASSERT_EQ(viseme.sigmas.size(), arkit_count);
    for (std::size_t s = 0; s < arkit_count; ++s) EXPECT_GT(viseme.sigmas[s], 0) << viseme.label;
  }
}

TEST(ReadVisemes, TheProjectsTableIsTheSameLeftAndRight) {
  for (const Viseme& viseme : read_visemes(engine::File::at(table_path)).visemes)
    for (const std::string_view name : arkit_names)
      if (name.ends_with("Left") && name != "jawLeft" && name != "mouthLeft") {
        const std::string right = std::string(name.substr(0, name.size() - 4)) + "Right";
        EXPECT_EQ(weight(viseme, name), weight(viseme, right)) << viseme.label << " " << name;
      }
}

TEST(ReadVisemes, TheProjectsTableMakesTheShapesThatPhoneticsKnows) {
  const Visemes visemes = read_visemes(engine::File::at(table_path));
  for (const char* label : {"P.c", "B.c", "M", "P", "B"}) EXPECT_EQ(entry(visemes, label).contact, "lips") << label;
  for (const char* label : {"F", "V"}) EXPECT_EQ(entry(visemes, label).contact, "teeth") << label;
  for (const char* label : {"AA", "AE", "AH", "AO", "AW", "AY", "EH", "OW"})
    EXPECT_GE(entry(visemes, label).open_mm, 1.5) << label;
  EXPECT_GT(weight(entry(visemes, "UW"), "mouthPucker"), 0.5);
  EXPECT_GT(weight(entry(visemes, "IY"), "mouthSmileLeft"), 0.25);
  EXPECT_GT(weight(entry(visemes, "AA"), "jawOpen"), weight(entry(visemes, "IH"), "jawOpen"));
  EXPECT_GT(weight(entry(visemes, "TH"), "tongueOut"), 0);
}

TEST(ReadVisemes, ANameWithoutASideMeansBoth) {
  const Visemes visemes = read_visemes(edited("\"mouthSmile\": 0.37", "\"mouthSmile\": 0.5, \"mouthPressLeft\": 0.25"));
  EXPECT_EQ(weight(entry(visemes, "IY"), "mouthSmileLeft"), 0.5f);
  EXPECT_EQ(weight(entry(visemes, "IY"), "mouthSmileRight"), 0.5f);
  EXPECT_EQ(weight(entry(visemes, "IY"), "mouthPressLeft"), 0.25f);
  EXPECT_EQ(weight(entry(visemes, "IY"), "mouthPressRight"), 0.0f);
}

TEST(ReadVisemes, ASingleShapesSigmaBeatsItsGroups) {
  const Visemes visemes = read_visemes(edited("\"sigmas\": {\"round\": 0.6}},\n    \"AE\"",
                                              "\"sigmas\": {\"mouthPucker\": 2, \"round\": 0.5}},\n    \"AE\""));
  EXPECT_EQ(entry(visemes, "AA").sigmas[arkit_index("mouthPucker")], 2.0f);
  EXPECT_EQ(entry(visemes, "AA").sigmas[arkit_index("mouthFunnel")], 0.5f);
}

TEST(ReadVisemes, NamesAMisspeltShape) {
  EXPECT_THROW_TEXT(
      read_visemes(edited("\"jawOpen\": 0.46", "\"jawOpne\": 0.46")),
      "the viseme table: /visemes/AA/weights/jawOpne names \"jawOpne\", which is not one of ARKit's 52 shapes; "
      "did you mean \"jawOpen\"?");
}

TEST(ReadVisemes, NamesAMisspeltKey) {
  EXPECT_THROW_TEXT(read_visemes(edited("\"sigma\": 0.32", "\"sgima\": 0.32")),
                    "the viseme table: /visemes/AA/sgima is not known here; did you mean \"sigma\"?");
}

TEST(ReadVisemes, NamesAMisspeltPhone) {
  EXPECT_THROW_TEXT(read_visemes(edited("\"P.c\"", "\"P.x\"")),
                    "the viseme table: /visemes/P.x is not a phone of the CMU dictionary; did you mean \"P.c\"?");
}

TEST(ReadVisemes, ListsMissingPhones) {
  EXPECT_THROW_TEXT(
      read_visemes(engine::File::from_bytes(R"({"visemes": {"AA": {"weights": {}}}})", ".json")),
      "the viseme table: /visemes lacks AE, AH, AO, AW, AY, B, CH, D, DH, EH, ER, EY, F, G, HH, IH, IY, JH, K, "
      "L, M, N, NG, OW, OY, P, R, S, SH, T, TH, UH, UW, V, W, Y, Z, ZH, SIL, P.c, P.r, B.c, B.r, T.c, T.r, "
      "D.c, D.r, K.c, K.r, G.c, G.r; expected the 39 phones, SIL, and closure and release of P B T D K G");
}

TEST(ReadVisemes, RejectsAWeightOutOfRange) {
  EXPECT_THROW_TEXT(read_visemes(edited("\"jawOpen\": 0.46", "\"jawOpen\": 1.5")),
                    "the viseme table: /visemes/AA/weights/jawOpen is 1.5, expected a number from 0 to 1");
  EXPECT_THROW_TEXT(read_visemes(edited("\"jawOpen\": 0.46", "\"jawOpen\": \"wide\"")),
                    "the viseme table: /visemes/AA/weights/jawOpen is \"wide\", expected a number from 0 to 1");
}

TEST(ReadVisemes, RejectsAnUnknownContact) {
  EXPECT_THROW_TEXT(read_visemes(edited("\"contact\": \"lips\"", "\"contact\": \"tongue\"")),
                    "the viseme table: /visemes/B/contact is \"tongue\", expected \"lips\" or \"teeth\"");
}

TEST(ReadVisemes, SaysInWhichLineJsonBreaks) {
  EXPECT_THROW_TEXT(read_visemes(engine::File::from_bytes("{\n\"visemes\": {\n,", ".json")),
                    "the viseme table: line 3 is not JSON, expected a viseme table");
}

TEST(ReadVisemes, RejectsWhatIsNoTable) {
  EXPECT_THROW_TEXT(read_visemes(engine::File::from_bytes("[1, 2]", ".json")),
                    "the viseme table: the table is [1,2], expected an object {...}");
  EXPECT_THROW_TEXT(read_visemes(engine::File::at("/nowhere/v.json")), "v.json: cannot be read as a file");
}

}  // namespace
}  // namespace face::trajectory
