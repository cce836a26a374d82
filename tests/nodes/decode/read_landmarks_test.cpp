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
ReadLandmarksResult landmarks_of(const std::string& path) { return read_landmarks(engine::File::at(path)); }
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
  EXPECT_THROW_TEXT(landmarks("{\"image_size\": [360, 288],\n \"points\": {\"a\": [1e400, 2]}}"),
                    "points.json line 2: found 1e400, expected a number of at most 1.8e308 in size");
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

TEST(ReadLandmarks, ReadsTheSharesOfMediaPipeByTheSizeOfTheImage) {
  const test::Temporary temporary;
  const Image image{200, 100, 1, std::vector<std::uint8_t>(20000)};
  const std::string face = R"([{"x": 0.5, "y": 0.25, "z": -0.1}, {"x": 1.01, "y": 0.5, "z": 0}])";
  for (const std::string& text :
       {face, "[" + face + "]", R"({"face_landmarks": [)" + face + "]}", R"({"faceLandmarks": [)" + face + "]}",
        R"({"multi_face_landmarks": [{"landmark": )" + face + "}]}"}) {
    const auto result = read_landmarks(engine::File::at(temporary.write("face.json", text)), &image);
    ASSERT_EQ(result.landmarks.points.size(), 2u) << text;
    EXPECT_EQ(result.landmarks.points[0].name, "0");
    EXPECT_EQ(result.landmarks.points[0].x_px, 99.5);  // the middle lies between pixels 99 and 100
    EXPECT_EQ(result.landmarks.points[0].y_px, 24.5);
    EXPECT_TRUE(result.landmarks.points[0].valid);
    EXPECT_FALSE(result.landmarks.points[1].valid);  // outside
    EXPECT_EQ(result.image_width_px, 200);
  }
  EXPECT_EQ(landmarks(R"({"image_size": [400, 100], "landmarks": [{"x": 0.5, "y": 0.5}]})").landmarks.points[0].x_px,
            199.5);
  EXPECT_THROW_TEXT(landmarks(R"([{"x": 0.5, "y": 0.5}])"),
                    "points.json: its points are shares of an image's width and height: connect the image, or put "
                    "\"image_size\": [width, height] into the file");
  EXPECT_THROW_TEXT(landmarks(R"({"image_size": [4, 4], "landmarks": [{"x": 0, "y": 0}, {"x": 0}]})"),
                    "points.json at /landmarks/1: found {\"x\":0}, expected an object with \"y\"");
}

TEST(ReadLandmarks, ReadsPtsWhosePixelsCountFromOne) {
  const test::Temporary temporary;
  const auto read = [&](const std::string& text, const Image* image = nullptr) {
    return read_landmarks(engine::File::at(temporary.write("face.pts", text)), image);
  };
  const auto result = read("version: 1\r\nn_points:  2\r\n{\r\n1.0 2.5\r\n 10 20 \r\n}\r\n");
  ASSERT_EQ(result.landmarks.points.size(), 2u);
  EXPECT_EQ(result.landmarks.points[0].name, "0");
  EXPECT_EQ(result.landmarks.points[0].x_px, 0);
  EXPECT_EQ(result.landmarks.points[0].y_px, 1.5);
  EXPECT_EQ(result.landmarks.points[1].x_px, 9);
  EXPECT_EQ(result.image_width_px, 0);
  const Image small{5, 5, 1, std::vector<std::uint8_t>(25)};
  EXPECT_THROW_TEXT(read("n_points: 1\n{\n9 2\n}\n", &small),
                    "face.pts:3: found (8, 1), expected a point inside the image of 5 x 5 pixels");
  EXPECT_THROW_TEXT(read("version: 1\nn_points: 3\n{\n1 2\n}\n"), "face.pts: found 1 points, n_points says 3");
  EXPECT_THROW_TEXT(read("version: 1\n{\n1 two\n}\n"), "face.pts:3: found \"1 two\", expected x and y of a point");
  EXPECT_THROW_TEXT(read("version: 1\n{\n1 2\n"), "face.pts:3: found the end of the file, expected }");
  EXPECT_THROW_TEXT(read("hello\n"), "face.pts:1: found \"hello\", expected version:, n_points: or {");
}

TEST(ReadLandmarks, ScalesPointsToThePictureInAnotherSize) {
  const test::Temporary temporary;
  const Image twice{8, 6, 1, std::vector<std::uint8_t>(48)};
  const auto result = read_landmarks(
      engine::File::at(temporary.write("p.json", R"({"image_size": [4, 3], "points": {"a": [0, 1], "b": [3, 2]}})")),
      &twice);
  EXPECT_EQ(result.image_width_px, 8);
  EXPECT_EQ(result.landmarks.points[0].x_px, 0.5);  // the centre of the first pixel is between the first two
  EXPECT_EQ(result.landmarks.points[0].y_px, 2.5);
  EXPECT_EQ(result.landmarks.points[1].x_px, 6.5);
}

// A mesh of MediaPipe's whose point i is at i / 1000 across.
std::string mesh(int count) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += (i == 0 ? "[" : ",") + std::string("{\"x\":") + std::to_string(i / 1000.0) + ",\"y\":0.5}";
  return text + "]";
}

TEST(ReadLandmarks, GivesMediaPipesPointsTheNamesThatAreAskedFor) {
  const test::Temporary temporary;
  const Image image{1000, 100, 1, std::vector<std::uint8_t>(100000)};
  const auto read = [&](int count, LandmarkNames names) {
    return read_landmarks(engine::File::at(temporary.write("face.json", mesh(count))), &image, {names, -1}).landmarks;
  };
  EXPECT_EQ(read(478, LandmarkNames::file).points.size(), 478u);
  const Landmarks all = read(478, LandmarkNames::multi_pie);
  ASSERT_EQ(all.points.size(), 68u);
  EXPECT_EQ(all.points[36].name, "36");
  EXPECT_NEAR(all.points[36].x_px, 33 - 0.5, 1e-9);  // outer corner of the right eye
  EXPECT_NEAR(all.points[8].x_px, 152 - 0.5, 1e-9);  // chin
  EXPECT_EQ(all.points[8].name, "08");
  const test::Temporary other;
  // As sides are checked, the points lie as on a face: left is right of right.
  std::string text = mesh(468);
  const Landmarks clip =
      read_landmarks(engine::File::at(other.write("face.json", text)), &image, {LandmarkNames::clip, -1}).landmarks;
  ASSERT_EQ(clip.points.size(), 18u);
  EXPECT_EQ(clip.points[0].name, "eye_inner_r");
  EXPECT_NEAR(clip.points[0].x_px, 133 - 0.5, 1e-9);
  EXPECT_EQ(clip.points[3].name, "lip_0");
  EXPECT_NEAR(clip.points[3].x_px, 61 - 0.5, 1e-9);
  EXPECT_EQ(read(400, LandmarkNames::file).points.size(), 400u);
  EXPECT_THROW_TEXT(read(400, LandmarkNames::multi_pie), "MediaPipe's face mesh has 400 points, expected 468 or 478");
}

TEST(ReadLandmarks, TakesAClipsPointsFromMultiPiesAndLeavesItsOwn) {
  std::string points;
  for (int i = 0; i < 68; ++i)
    points += (i == 0 ? "" : ",") + std::string("\"") + std::to_string(i) + "\":[" + std::to_string(i) + ",3]";
  const test::Temporary temporary;
  const auto read = [&](const std::string& list, int frame = -1) {
    return read_landmarks(engine::File::at(temporary.write(
                              "p.json", R"({"frame": 7, "image_size": [100, 9], "points": {)" + list + "}}")),
                          nullptr, {LandmarkNames::clip, frame})
        .landmarks;
  };
  const Landmarks clip = read(points);
  ASSERT_EQ(clip.points.size(), 18u);
  EXPECT_EQ(clip.points[2].name, "nose_tip");
  EXPECT_EQ(clip.points[2].x_px, 30);
  EXPECT_EQ(read(R"("chin": [1, 2])").points.size(), 1u);
  EXPECT_EQ(read(R"("chin": [1, 2])", 7).points.size(), 1u);
  EXPECT_THROW_TEXT(read(R"("chin": [1, 2])", 0),
                    "p.json at /frame: found 7, expected 0: these points are of another frame of the clip");
  EXPECT_THROW_TEXT(read(R"("eye_inner_r": [5, 2], "eye_inner_l": [3, 2])"),
                    "p.json: eye_inner_r lies at 5, 2, right of eye_inner_l at 3, 2; _r (and lip_0) is the face's own "
                    "right, which is left in the picture: are the names swapped?");
}

// Were followed without a word: a nose that is called chin, an upper lip that is called lower.
TEST(ReadLandmarks, RejectsPointsOfAClipWhoseNamesAreSwappedFromAboveToBelow) {
  const test::Temporary temporary;
  const auto read = [&](const std::string& list) {
    return read_landmarks(
        engine::File::at(temporary.write("p.json", R"({"image_size": [100, 100], "points": {)" + list + "}}")), nullptr,
        {LandmarkNames::clip, -1});
  };
  EXPECT_EQ(
      read(R"("nose_tip": [50, 40], "lip_3": [50, 60], "lip_9": [50, 70], "chin": [50, 90])").landmarks.points.size(),
      4u);
  EXPECT_THROW_TEXT(
      read(R"("nose_tip": [50, 90], "lip_9": [50, 70], "chin": [50, 40])"),
      "p.json: nose_tip lies at 50, 90, below lip_9 at 50, 70: are the names swapped, or the picture upside "
      "down?");
  EXPECT_THROW_TEXT(read(R"("lip_3": [50, 70], "lip_9": [50, 60])"),
                    "p.json: lip_3 lies at 50, 70, below lip_9 at 50, 60: are the names swapped, or the picture upside "
                    "down?");
}

TEST(ReadLandmarks, RejectsAnImageOfAnotherShapeAndOtherFiles) {
  const test::Temporary temporary;
  const Image image{4, 4, 1, std::vector<std::uint8_t>(16)};
  EXPECT_THROW_TEXT(
      read_landmarks(engine::File::at(temporary.write("p.json", R"({"image_size": [3, 4], "points": {"a": [1, 1]}})")),
                     &image),
      "p.json at /image_size: found 3 x 4, but the image is 4 x 4 pixels, which is no other size of it");
  EXPECT_THROW_TEXT(landmarks_of(temporary.write("face.xml", "<x/>")),
                    "face.xml: found the suffix \".xml\", expected our JSON, MediaPipe's JSON, or .pts");
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
