// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_landmarks.h"

#include "nodes/decode/read_corrections.h"
#include "tests/nodes/decode/temporary.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::decode;

namespace {

ReadLandmarksResult landmarks(const std::string& json) {
  const test::Temporary temporary;
  return read_landmarks(engine::File::at(temporary.write("points.json", json)));
}
engine::Seq<Landmarks> corrections(const std::string& json) {
  const test::Temporary temporary;
  return read_corrections(engine::File::at(temporary.write("fix.json", json)));
}

}  // namespace

TEST(ReadLandmarks, KeepsTheFilesOrder) {
  const auto result =
      landmarks(R"({"image_size": [360, 288], "points": {"z": [1.5, 2], "a": [0, 0], "m": [359.5, 287.5]}})");
  ASSERT_EQ(result.landmarks.points.size(), 3u);
  EXPECT_EQ(result.landmarks.points[0].name, "z");
  EXPECT_EQ(result.landmarks.points[0].x_px, 1.5);
  EXPECT_EQ(result.landmarks.points[1].name, "a");
  EXPECT_TRUE(result.landmarks.points[2].valid);
  EXPECT_EQ(result.image_width_px, 360);
  EXPECT_EQ(result.image_height_px, 288);
}

TEST(ReadLandmarks, ReadsTheEighteenPointsOfAClip) {
  DATA_FILE(path, "grid/bbaf2n.landmarks.json");
  const auto result = read_landmarks(engine::File::at(path));
  ASSERT_EQ(result.landmarks.points.size(), 18u);
  EXPECT_EQ(result.landmarks.points[3].name, "lip_0");
  EXPECT_EQ(result.landmarks.points[3].y_px, 218.5);
}

TEST(ReadLandmarks, RejectsAPointOutsideTheImage) {
  EXPECT_THROW_TEXT(
      landmarks(R"({"image_size": [360, 288], "points": {"lip_3": [400, 214.5]}})"),
      "points.json at /points/lip_3: found (400, 214.5), expected a point inside the image of 360 x 288 pixels");
  EXPECT_THROW_TEXT(
      landmarks(R"({"image_size": [360, 288], "points": {"chin": [40, -1]}})"),
      "points.json at /points/chin: found (40, -1), expected a point inside the image of 360 x 288 pixels");
}

TEST(ReadLandmarks, RejectsWhatIsNoLandmarkFile) {
  EXPECT_THROW_TEXT(landmarks(""), "points.json: is empty, expected JSON");
  EXPECT_THROW_TEXT(landmarks("{\"image_size\": [360,\n 288], \"points\" }"),
                    "points.json line 2 column 17: is not JSON: found '}' where the text cannot go on");
  EXPECT_THROW_TEXT(landmarks("{\"points\": {}}"),
                    "points.json: found {\"points\":{}}, expected an object with \"image_size\"");
  EXPECT_THROW_TEXT(landmarks(R"({"image_size": [1, 2]})"),
                    "points.json: found {\"image_size\":[1,2]}, expected an object with \"points\"");
  EXPECT_THROW_TEXT(landmarks(R"({"image_size": [1, 2], "points": {}})"),
                    "points.json at /points: found {}, expected an object of names with [x, y]");
  EXPECT_THROW_TEXT(landmarks(R"({"image_size": [1, 2], "points": {"a": [1, "two"]}})"),
                    "points.json at /points/a/1: found \"two\", expected a number");
  EXPECT_THROW_TEXT(landmarks(R"({"image_size": [1, 2], "points": {"a": 1}})"),
                    "points.json at /points/a: found 1, expected [x, y] in pixels");
}

TEST(ReadCorrections, GathersThePointsOfAFrameAndSortsFrames) {
  const auto seq =
      corrections(R"([{"frame": 41, "point": "lip_3", "xy": [1, 2]}, {"frame": 7, "point": "chin", "xy": [3, 4]},
                                   {"frame": 41, "point": "lip_4", "xy": [5, 6]}, {"frame": 100, "point": "chin", "xy": [7, 8]}])");
  ASSERT_EQ(seq.size(), 3u);
  EXPECT_EQ(seq.id(0), "7");
  EXPECT_EQ(seq.id(1), "41");
  EXPECT_EQ(seq.id(2), "100");
  ASSERT_EQ(seq.at(1)->points.size(), 2u);
  EXPECT_EQ(seq.at(1)->points[1].name, "lip_4");
  EXPECT_EQ(seq.at(1)->points[1].y_px, 6);
}

TEST(ReadCorrections, AcceptsAnEmptyList) { EXPECT_TRUE(corrections("[]").empty()); }

TEST(ReadCorrections, RejectsWhatIsNoListOfCorrections) {
  EXPECT_THROW_TEXT(corrections("{}"), "fix.json: found {}, expected a list of corrections");
  EXPECT_THROW_TEXT(corrections(R"([{"frame": -1, "point": "a", "xy": [1, 2]}])"),
                    "fix.json at /0/frame: found -1, expected a whole number from 0");
  EXPECT_THROW_TEXT(corrections(R"([{"frame": 1, "xy": [1, 2]}])"),
                    "fix.json at /0: found {\"frame\":1,\"xy\":[1,2]}, expected an object with \"point\"");
  EXPECT_THROW_TEXT(corrections(R"([{"frame": 1, "point": "a", "xy": [1]}])"),
                    "fix.json at /0/xy: found [1], expected [x, y] in pixels");
  EXPECT_THROW_TEXT(
      corrections(R"([{"frame": 1, "point": "a", "xy": [1, 2]}, {"frame": 1, "point": "a", "xy": [1, 3]}])"),
      "fix.json at /1: found a second correction of a in frame 1, expected one");
}
