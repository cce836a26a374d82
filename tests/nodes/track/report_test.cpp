// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/report.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::track;

namespace {

Landmarks frame(bool eye, bool lip) { return {{{"eye", 1, 2, eye}, {"lip", 3, 4, lip}}}; }

struct Heard : engine::Progress {
  void warn(const std::string& text) override { warnings.push_back(text); }
  std::vector<std::string> warnings;
};

}  // namespace

TEST(Report, NamesFramesAndPointsThatAreLost) {
  Heard heard;
  const ReportResult result = report(
      {{frame(true, true), frame(true, false), frame(true, false), frame(false, false), frame(false, false),
        frame(true, true), frame(false, true)}},
      engine::Seq<std::string>({"start", "followed", "followed", "even", "even", "found", "followed"}), nullptr, heard);
  EXPECT_EQ(result.text,
            "7 frames, 14 points, 7 of them lost\n"
            "frames 3 to 4: nothing to see: black, white or one colour\n"
            "frame 5: the face is found again\n"
            "frames 1 to 2: lost lip\n"
            "frame 6: lost eye\n");
  EXPECT_EQ(heard.warnings.size(), 2u);
  EXPECT_EQ(result.file.bytes(), result.text);
}

TEST(Report, NamesFramesOfAnotherLength) {
  Heard heard;
  const Timeline timeline{{0, 0.04, 0.08, 0.16, 0.2}, 0.24};
  const engine::Seq<Landmarks> frames(std::vector<Landmarks>(5, frame(true, true)));
  const engine::Seq<std::string> state(std::vector<std::string>(5, "followed"));
  EXPECT_EQ(report(frames, state, &timeline, heard).text,
            "5 frames, 10 points, 0 of them lost\n"
            "frame 2: shown for 80 ms, most for 40 ms: the frame rate varies\n");
  EXPECT_EQ(heard.warnings,
            (std::vector<std::string>{"frame 2: shown for 80 ms, most for 40 ms: the frame rate varies"}));
}

// Points placed beside the face were followed over ten seconds of wall without a warning.
TEST(Report, WarnsWhereManyPointsAreLost) {
  Heard heard;
  std::vector<Landmarks> frames(20, frame(true, true));
  const engine::Seq<std::string> state(std::vector<std::string>(20, "followed"));
  for (const int i : {3, 5, 7, 9}) frames[static_cast<std::size_t>(i)] = frame(true, false);
  report(engine::Seq<Landmarks>(frames), state, nullptr, heard);
  EXPECT_TRUE(heard.warnings.empty());  // a tenth
  frames[11] = frame(true, false);
  const std::string expected =
      "13 % of the points are lost in frames that show something, usually it is less than 5 %: do they lie on the face "
      "in the first frame?";
  EXPECT_EQ(report(engine::Seq<Landmarks>(frames), state, nullptr, heard).text.substr(37, expected.size() + 1),
            expected + "\n");
  EXPECT_EQ(heard.warnings, std::vector<std::string>{expected});
}

TEST(Report, IsShortWhereAllIsWell) {
  Heard heard;
  EXPECT_EQ(report({}, {}, nullptr, heard).text, "0 frames, 0 points, 0 of them lost\n");
  EXPECT_TRUE(heard.warnings.empty());
}

TEST(Report, RejectsUnequalLengths) {
  Heard heard;
  EXPECT_THROW_TEXT(report({{frame(true, true)}}, {}, nullptr, heard), "landmarks has 1 frames, state has 0");
}
