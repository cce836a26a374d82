// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <limits>
#include <sstream>

#include "nodes/export/csv.h"
#include "nodes/export/export_live_link_csv.h"
#include "nodes/export/export_table.h"
#include "nodes/export/export_tracks_csv.h"
#include "nodes/types/arkit.h"
#include "tests/support/expect_throw_text.h"

namespace face::exports {
namespace {

std::vector<std::string> lines_of(const engine::File& file) {
  std::vector<std::string> lines;
  std::istringstream in(file.bytes());
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(ExportTracksCsv, WritesOneRowPerFrameAndPoint) {
  const engine::Seq<Landmarks> tracks({Landmarks{{{"lip left", 12.5, 99.0004, true}, {"a,\"b\"", -0.0001, 1e6, false}}},
                                       Landmarks{}, Landmarks{{{"lip left", 13, 100, true}}}},
                                      {"16", "17", "20"});
  const engine::File file = export_tracks_csv(tracks);
  EXPECT_EQ(file.suffix(), ".csv");
  EXPECT_EQ(file.bytes(),
            "frame,point,x_px,y_px,valid\n"
            "16,lip left,12.500,99.000,1\n"
            "16,\"a,\"\"b\"\"\",0.000,1000000.000,0\n"
            "20,lip left,13.000,100.000,1\n");
}

TEST(ExportTracksCsv, RejectsAnEmptySequence) {
  EXPECT_THROW_TEXT(export_tracks_csv({}), "there are no frames to export");
}

TEST(ExportLiveLinkCsv, HasTheColumnsOfLiveLinkFace) {
  Weights weights;
  weights.values.assign(53, 0.0f);
  weights.values[arkit_index("jawOpen")] = 0.75f;
  weights.values[52] = 1;  // the rig's own: not in the file
  const engine::Seq<Weights> frames({weights, Weights{{0.123456789f}}});
  const engine::File file = export_live_link_csv(frames, Timeline{{0, 3725.5}, 3726});
  EXPECT_EQ(file.suffix(), ".csv");
  const std::vector<std::string> lines = lines_of(file);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(
      lines[0],
      "Timecode,BlendShapeCount,EyeBlinkLeft,EyeLookDownLeft,EyeLookInLeft,EyeLookOutLeft,EyeLookUpLeft,EyeSquintLeft,"
      "EyeWideLeft,EyeBlinkRight,EyeLookDownRight,EyeLookInRight,EyeLookOutRight,EyeLookUpRight,EyeSquintRight,"
      "EyeWideRight,JawForward,JawRight,JawLeft,JawOpen,MouthClose,MouthFunnel,MouthPucker,MouthRight,MouthLeft,"
      "MouthSmileLeft,MouthSmileRight,MouthFrownLeft,MouthFrownRight,MouthDimpleLeft,MouthDimpleRight,"
      "MouthStretchLeft,MouthStretchRight,MouthRollLower,MouthRollUpper,MouthShrugLower,MouthShrugUpper,"
      "MouthPressLeft,MouthPressRight,MouthLowerDownLeft,MouthLowerDownRight,MouthUpperUpLeft,MouthUpperUpRight,"
      "BrowDownLeft,BrowDownRight,BrowInnerUp,BrowOuterUpLeft,BrowOuterUpRight,CheekPuff,CheekSquintLeft,"
      "CheekSquintRight,NoseSneerLeft,NoseSneerRight,TongueOut,HeadYaw,HeadPitch,HeadRoll,LeftEyeYaw,LeftEyePitch,"
      "LeftEyeRoll,RightEyeYaw,RightEyePitch,RightEyeRoll");
  for (const std::string& line : lines) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 62) << line;
  EXPECT_EQ(lines[1].substr(0, 29), "00:00:00:00.000,61,0.000000,0");
  EXPECT_NE(lines[1].find(",0.750000,"), std::string::npos);
  EXPECT_EQ(lines[1].find("1.000000"), std::string::npos);
  EXPECT_EQ(lines[2].substr(0, 36), "01:02:05:30.000,61,0.123457,0.000000");
}

TEST(ExportLiveLinkCsv, SpellsTimesBetweenFramesInThousandths) {
  ExportLiveLinkCsvOptions options;
  options.timecode_rate_hz = 25;
  const std::vector<std::string> lines =
      lines_of(export_live_link_csv(engine::Seq<Weights>({{}, {}, {}}), Timeline{{0, 0.05, 0.99999}, 2}, options));
  EXPECT_EQ(lines[1].substr(0, 15), "00:00:00:00.000");
  EXPECT_EQ(lines[2].substr(0, 15), "00:00:00:01.250");
  EXPECT_EQ(lines[3].substr(0, 15), "00:00:01:00.000");
}

TEST(ExportLiveLinkCsv, RejectsWhatCannotBeWritten) {
  EXPECT_THROW_TEXT(export_live_link_csv({}, {}), "there are no frames to export");
  const engine::Seq<Weights> odd({Weights{{0, INFINITY}}}, {"17"});
  EXPECT_THROW_TEXT(export_live_link_csv(odd, Timeline{{0}, 1}),
                    "weight eyeLookDownLeft of frame 17 is not a finite number");
}

TEST(AppendFixed, WritesAPointWhateverTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where the machine has it
  std::string text;
  append_fixed(text, 1234.5678, 2);
  text += ' ';
  append_fixed(text, -0.001, 2);
  text += ' ';
  append_fixed(text, -0.5, 1);
  text += ' ';
  append_fixed(text, -1e300, 0);
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_EQ(text.substr(0, 17), "1234.57 0.00 -0.5");
}

TEST(ExportTable, WritesNumbersThatReadBackExactly) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Table table{{"a_mm", "b, c"}, {{"all", {0.1, nan}}, {"own \"x\"", {-3, 1e300}}}};
  const engine::File csv = export_table(table);
  EXPECT_EQ(csv.suffix(), ".csv");
  EXPECT_EQ(csv.bytes(), "name,a_mm,\"b, c\"\nall,0.1,\n\"own \"\"x\"\"\",-3,1e+300\n");
  const engine::File json = export_table(table, {TableFormat::json});
  EXPECT_EQ(json.suffix(), ".json");
  EXPECT_EQ(json.bytes(),
            "{\n  \"columns\": [\"a_mm\", \"b, c\"],\n  \"rows\": {\n    \"all\": [0.1, null],\n"
            "    \"own \\\"x\\\"\": [-3, 1e+300]\n  }\n}\n");
  EXPECT_EQ(export_table(Table{}).bytes(), "name\n");
}

TEST(ExportTable, RejectsRowsOfAnotherLength) {
  EXPECT_THROW_TEXT(export_table(Table{{"a", "b"}, {{"x", {1}}}}), "row x has 1 values, expected 2");
  EXPECT_THROW_TEXT(export_table(Table{{"a"}, {{"x", {1}}, {"x", {2}}}}, {TableFormat::json}),
                    "the table has two rows x, which JSON cannot hold");
}

}  // namespace
}  // namespace face::exports
