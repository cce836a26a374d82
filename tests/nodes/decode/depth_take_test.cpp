// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/depth_take.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "nodes/base/fringe_patterns.h"
#include "tests/nodes/decode/temporary.h"
#include "tests/support/depth_pictures.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::decode;

using test::ball;
using test::pgm;

constexpr int width = test::depth_width, height = test::depth_height;

// An uncompressed OpenEXR file of one channel of floats (openexr.com, OpenEXR File Layout).
std::string exr(const std::vector<float>& values) {
  const std::string channel = "Y";
  std::string out;
  const auto put = [&](auto value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); };
  const auto attribute = [&](const std::string& name, const std::string& type, std::int32_t size) {
    out += name + '\0' + type + '\0';
    put(size);
  };
  put(std::uint32_t{20000630});
  put(std::uint32_t{2});
  attribute("channels", "chlist", static_cast<std::int32_t>(channel.size() + 1 + 16 + 1));
  out += channel + '\0';
  for (const std::int32_t v : {2, 0, 1, 1}) put(v);
  out += '\0';
  attribute("compression", "compression", 1);
  out += '\0';
  for (const char* name : {"dataWindow", "displayWindow"}) {
    attribute(name, "box2i", 16);
    for (const std::int32_t v : {0, 0, width - 1, height - 1}) put(v);
  }
  attribute("lineOrder", "lineOrder", 1);
  out += '\0';
  attribute("pixelAspectRatio", "float", 4);
  put(1.0f);
  attribute("screenWindowCenter", "v2f", 8);
  put(0.0f), put(0.0f);
  attribute("screenWindowWidth", "float", 4);
  put(1.0f);
  out += '\0';
  const std::size_t lines = out.size() + 8 * height;
  for (int y = 0; y < height; ++y)
    put(static_cast<std::uint64_t>(lines + static_cast<std::size_t>(y) * (8 + 4 * width)));
  for (int y = 0; y < height; ++y) {
    put(static_cast<std::int32_t>(y));
    put(static_cast<std::int32_t>(4 * width));
    for (int x = 0; x < width; ++x) put(values[static_cast<std::size_t>(y * width + x)]);
  }
  return out;
}

class Heard : public engine::Progress {
 public:
  void warn(const std::string& text) override { texts.push_back(text); }
  std::vector<std::string> texts;
};

// A recorded stream on disk.
class Stream {
 public:
  explicit Stream(const std::string& camera = test::depth_camera_json) { files_.write("camera.json", camera); }
  void depth(const std::string& frame, const std::vector<int>& values) {
    files_.write("depth/a/" + frame + ".pgm", pgm(values, 65535));
  }
  void picture(const std::string& frame, int grey = 90) {
    files_.write("picture/a/" + frame + ".pgm", pgm(std::vector<int>(width * height, grey), 255));
  }
  void frame(int number) {
    depth(std::to_string(number), ball());
    picture(std::to_string(number), 50 + number);
  }
  void write(const std::string& name, const std::string& bytes) { files_.write(name, bytes); }
  void remove(const std::string& name) { std::filesystem::remove(files_.path(name)); }

  engine::File folder() const {
    std::vector<engine::File::Entry> entries;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(files_.folder()))
      if (entry.is_regular_file())
        entries.push_back({std::filesystem::relative(entry.path(), files_.folder()).string(), entry.path().string()});
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return engine::File::folder(files_.folder().string(), entries);
  }

  DepthTakeResult read() {
    ids.clear(), scans.clear(), heard.texts.clear();
    engine::SeqWriter<DepthScan> writer([&](std::string id, DepthScan scan) {
      ids.push_back(std::move(id));
      scans.push_back(std::move(scan));
    });
    return depth_take(folder(), "a", writer, options, heard);
  }

  DepthTakeOptions options;
  std::vector<std::string> ids;
  std::vector<DepthScan> scans;
  Heard heard;

 private:
  test::Temporary files_;
};

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

// The first warning of a take that has no frame left.
std::string why_nothing_is_left(Stream& stream) {
  const DepthTakeResult result = stream.read();
  EXPECT_FALSE(result.kept);
  EXPECT_TRUE(stream.scans.empty());
  EXPECT_TRUE(result.timeline.time_s.empty());
  EXPECT_EQ(stream.heard.texts.size(), 1u);
  EXPECT_EQ(result.report.substr(0, result.report.find('\n')), stream.heard.texts.at(0));
  return stream.heard.texts.at(0);
}

}  // namespace

TEST(DepthTake, ReadsDepthPictureAndCamera) {
  Stream stream;
  for (const int n : {3, 4, 5}) stream.frame(n);
  const DepthTakeResult result = stream.read();
  EXPECT_EQ(stream.ids, (std::vector<std::string>{"3", "4", "5"}));
  EXPECT_EQ(result.timeline.time_s, (std::vector<double>{0, 0.025, 0.05}));
  EXPECT_EQ(result.report, "");
  EXPECT_TRUE(result.kept);
  const DepthScan& scan = stream.scans[1];
  EXPECT_EQ(scan.camera.focal_px, 200);
  EXPECT_EQ(scan.picture.channels, 1);
  EXPECT_EQ(scan.picture.pixels[0], 54);
  const std::vector<int> depth = ball();
  for (std::size_t i = 0; i < depth.size(); ++i) EXPECT_NEAR(scan.depth_mm[i], 0.1 * depth[i], 1e-4);
}

TEST(DepthTake, ReadsExrInMetres) {
  Stream stream(R"({"fx": 200, "cx": 31.5, "cy": 23.5, "length_unit": "m"})");
  std::vector<float> metres;
  for (const int d : ball()) metres.push_back(d == 0 ? std::nanf("") : 1e-4f * static_cast<float>(d));
  stream.write("depth/a/0.exr", exr(metres));
  stream.picture("0");
  stream.read();
  ASSERT_EQ(stream.scans.size(), 1u);
  for (std::size_t i = 0; i < metres.size(); ++i) EXPECT_NEAR(stream.scans[0].depth_mm[i], 0.1 * ball()[i], 1e-3);
}

TEST(DepthTake, ReadsOrganisedCloudsWithTheirColours) {
  const std::vector<int> depth = ball();
  std::string xyz, ply =
                       "ply\nformat ascii 1.0\ncomment width 64\ncomment height 48\nelement vertex 3072\n"
                       "property float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                       "property uchar green\nproperty uchar blue\nend_header\n";
  for (int i = 0; i < width * height; ++i) {
    const double z = 0.1 * depth[static_cast<std::size_t>(i)];
    const std::string x = std::to_string((i % width - 31.5) * z / 200),
                      y = std::to_string((i / width - 23.5) * z / 200);
    xyz += x + " " + y + " " + std::to_string(z) + " 10 20 30\n";
    // The same with y up and z towards the viewer.
    ply += x + " " + std::to_string(-(i / width - 23.5) * z / 200) + " " + std::to_string(-z) + " 10 20 30\n";
  }
  for (const auto& [name, text] : {std::pair{"cloud/a/7.xyz", xyz}, std::pair{"cloud/a/7.ply", ply}}) {
    Stream stream;
    stream.write(name, text);
    const DepthTakeResult result = stream.read();
    EXPECT_EQ(result.report, "") << name;
    ASSERT_EQ(stream.scans.size(), 1u) << name;
    for (std::size_t i = 0; i < depth.size(); ++i)
      EXPECT_NEAR(stream.scans[0].depth_mm[i], 0.1 * depth[i], 1e-3) << name;
    EXPECT_EQ(stream.scans[0].picture.pixels[5], 30);
  }
}

// As Open3D and NumPy write them: colours as shares of 1. They came out black.
TEST(DepthTake, ReadsColoursOfCloudsThatAreSharesOfOne) {
  const std::vector<int> depth = ball();
  std::string xyz, floats, shorts;
  for (int i = 0; i < width * height; ++i) {
    const double z = 0.1 * depth[static_cast<std::size_t>(i)];
    const std::string place = std::to_string((i % width - 31.5) * z / 200) + " " +
                              std::to_string((i / width - 23.5) * z / 200) + " " + std::to_string(z);
    xyz += place + " 0.2 1 0.5\n";
    shorts += place + " 13107 65535 32768\n";
  }
  const auto ply = [](const std::string& type, const std::string& rows) {
    return "ply\nformat ascii 1.0\nelement vertex 3072\nproperty float x\nproperty float y\nproperty float "
           "z\nproperty " +
           type + " red\nproperty " + type + " green\nproperty " + type + " blue\nend_header\n" + rows;
  };
  for (const auto& [name, text] : {std::pair<std::string, std::string>{"cloud/a/7.xyz", xyz},
                                   {"cloud/a/7.ply", ply("float", xyz)},
                                   {"cloud/a/7.ply", ply("ushort", shorts)}}) {
    Stream stream;
    stream.write(name, text);
    stream.read();
    ASSERT_EQ(stream.scans.size(), 1u) << name;
    const auto& pixels = stream.scans[0].picture.pixels;
    EXPECT_EQ((std::vector<int>{pixels[0], pixels[1], pixels[2]}), (std::vector<int>{51, 255, 128})) << name;
  }
}

// A count so large that the bytes it asks for overflow was read beyond the file's end.
TEST(DepthTake, NamesACloudWhoseHeaderCannotBe) {
  const auto trouble = [](const std::string& count, const std::string& type) {
    Stream stream;
    stream.write("cloud/a/0.ply", "ply\nformat binary_little_endian 1.0\nelement vertex " + count + "\nproperty " +
                                      type + " x\nproperty float y\nproperty float z\nend_header\n0123456789ab");
    const std::string text = why_nothing_is_left(stream);
    return text.substr(text.find("cloud/a/0.ply"));
  };
  EXPECT_EQ(
      trouble("1152921504606846976", "double"),
      "cloud/a/0.ply: ends at byte 146, expected 1152921504606846976 points of 16 bytes from byte 134 on; the take "
      "is left out");
  EXPECT_EQ(trouble("1e300", "float"),
            "cloud/a/0.ply line 3: found \"element vertex 1e300\", expected a count; the take is left out");
  EXPECT_EQ(trouble("1", "half"),
            "cloud/a/0.ply line 4: found \"property half x\", expected a type of number (char to double); the take is "
            "left out");
}

TEST(DepthTake, MakesPixelsSquare) {
  // Rows twice as dense as columns.
  Stream stream(R"({"fx": 200, "fy": 300, "cx": 31.5, "cy": 23.5, "depth_unit_mm": 0.1})");
  std::vector<int> depth(width * height, 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (std::fabs((y - 23.5) / 300.0) < 0.04 && std::fabs((x - 31.5) / 200.0) < 0.06)
        depth[static_cast<std::size_t>(y * width + x)] = 9000;
  stream.depth("0", depth);
  stream.picture("0");
  stream.read();
  for (int y = 0; y < height; ++y)
    EXPECT_EQ(stream.scans[0].depth_mm[static_cast<std::size_t>(y * width + 31)] > 0,
              std::fabs((y - 23.5) / 200.0) < 0.04)
        << y;
}

TEST(DepthTake, NamesFramesThatAreWrongAndKeepsTheRest) {
  Stream stream;
  for (const int n : {1, 2, 3, 4, 5, 6, 7, 8, 12}) stream.frame(n);
  std::vector<int> swapped = ball(), small(width * height, 0);
  for (int& d : swapped) d /= 100;
  stream.depth("2", swapped);                                                   // cm for tenths of mm
  stream.write("mask/a/3.pgm", pgm(std::vector<int>(width * height, 0), 255));  // empty
  std::fill(small.begin() + 20 * width + 20, small.begin() + 20 * width + 44, 9000);
  std::fill(small.begin() + 21 * width + 20, small.begin() + 21 * width + 44, 9000);
  stream.depth("4", small);  // no face
  std::vector<int> wall(width * height, 14000);
  stream.depth("5", wall);  // a wall behind
  stream.write("depth/a/6.pgm", "P5 nonsense");
  stream.write("picture/a/7.pgm", pgm(std::vector<int>(20 * 20, 9), 255, 20));
  stream.write("depth/a/notes.pgm", "x");
  const DepthTakeResult result = stream.read();
  EXPECT_EQ(stream.ids, (std::vector<std::string>{"1", "8", "12"}));
  EXPECT_EQ(result.dropped, 6);
  EXPECT_EQ(result.timeline.time_s.back(), 11 / 40.0);
  ASSERT_EQ(stream.heard.texts.size(), 8u);
  EXPECT_EQ(stream.heard.texts[0],
            "take a, file depth/a/notes.pgm: its name is no frame number, expected one like 17.png; left out");
  EXPECT_EQ(stream.heard.texts[1],
            "take a, frame 2: its median depth is 8.4 mm, expected 150 to 4000: is the unit of depth 100 times what "
            "depth_unit_mm in camera.json says?; left out");
  EXPECT_EQ(stream.heard.texts[2], "take a, frame 3: its mask is empty; left out");
  EXPECT_EQ(stream.heard.texts[3],
            "take a, frame 4: it shows no face: 48 pixels are measured, the take's median is 1004; left out");
  EXPECT_EQ(stream.heard.texts[4],
            "take a, frame 5: it shows no face: its median depth is 1400 mm, the take's 844; left out");
  EXPECT_EQ(stream.heard.texts[5].substr(0, 31), "take a, frame 6: depth/a/6.pgm ");
  EXPECT_EQ(stream.heard.texts[6], "take a, frame 7: its picture 7.pgm is 20 x 20 pixels, expected 64 x 48; left out");
  EXPECT_EQ(stream.heard.texts[7], "take a, frames 9 to 11 are missing");
  EXPECT_EQ(std::count(result.report.begin(), result.report.end(), '\n'), 8);
}

// Of a stream of frame_0001.png each file was a warning.
TEST(DepthTake, SaysOnceThatNamesOfFilesAreNoNumbers) {
  Stream stream;
  stream.frame(1);
  for (const char* name : {"frame_2", "frame_3", "frame_4"}) stream.depth(name, ball());
  stream.read();
  EXPECT_EQ(stream.heard.texts,
            std::vector<std::string>{"take a, file depth/a/frame_2.pgm and 2 more: their names are no frame numbers, "
                                     "expected some like 17.png; left out"});
}

TEST(DepthTake, NamesFramesOfAnotherSizeAndDepthOfEightBits) {
  Stream stream(R"({"fx": 200, "cx": 31.5, "cy": 23.5, "depth_unit_mm": 0.1})");
  for (const int n : {1, 2, 3, 4}) stream.frame(n);
  stream.write("depth/a/2.pgm", pgm(std::vector<int>(56 * 48, 8440), 65535, 56));
  stream.write("picture/a/2.pgm", pgm(std::vector<int>(56 * 48, 9), 255, 56));
  stream.write("depth/a/4.pgm", pgm(std::vector<int>(width * height, 84), 255));
  const DepthTakeResult result = stream.read();
  EXPECT_EQ(stream.ids, (std::vector<std::string>{"1", "3"}));
  EXPECT_EQ(result.dropped, 2);
  ASSERT_EQ(stream.heard.texts.size(), 3u);
  EXPECT_EQ(stream.heard.texts[0], "take a, camera.json has no rate_hz: 40 frames per second are taken");
  EXPECT_EQ(stream.heard.texts[1], "take a, frame 2: it is 56 x 48 pixels, expected 64 x 48 as the others; left out");
  EXPECT_EQ(stream.heard.texts[2],
            "take a, frame 4: depth/a/4.pgm has 8 bits per pixel, expected 16 bits or an EXR: 256 steps are too few "
            "for depth; "
            "left out");
}

// Five pictures of fringes on a wall at 1,000 mm, half a metre wide, in formats that mix.
class FringeStream : public Stream {
 public:
  static constexpr const char* projector_json =
      R"({"fx": 1500, "cx": 511.5, "cy": 383.5, "width": 1024, "height": 768, "position_mm": [-100, 0, 0],
          "cam_from_world": [1, 0, 0, 0, 1, 0, 0, 0, 1]})";
  FringeStream() { write("projector.json", projector_json); }

  void fringes(int frame, double distance_mm = 1000) {
    const FringePatterns patterns;
    for (std::size_t k = 0; k < FringePatterns::count; ++k) {
      std::string grey, wide, colours;
      std::vector<float> floats;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const double at_mm = (x - 31.5) / 200 * distance_mm;
          const double column = 511.5 + 1500 * (at_mm + 100) / distance_mm;
          const double light = 0.1 + 0.7 * patterns.light(k, column);
          grey += static_cast<char>(std::lround(255 * light));
          const long level = std::lround(65535 * light);
          wide += static_cast<char>(level / 256), wide += static_cast<char>(level % 256);
          colours += std::string(3, grey.back());
          floats.push_back(static_cast<float>(light));
        }
      const std::string name = "pattern/a/" + std::to_string(frame) + "/" + std::to_string(k);
      if (k == 1)
        write(name + ".pgm", "P5\n64 48\n65535\n" + wide);
      else if (k == 2)
        write(name + ".ppm", "P6\n64 48\n255\n" + colours);
      else if (k == 3)
        write(name + ".exr", exr(floats));
      else
        write(name + ".pgm", "P5\n64 48\n255\n" + grey);
    }
  }
};

TEST(DepthTake, ReadsFringePicturesInAnyFormat) {
  FringeStream stream;
  stream.fringes(0);
  stream.fringes(1, 1040);
  const DepthTakeResult result = stream.read();
  EXPECT_EQ(result.report, "");
  ASSERT_EQ(stream.scans.size(), 2u);
  for (std::size_t f = 0; f < 2; ++f) {
    std::size_t found = 0;
    for (const float depth : stream.scans[f].depth_mm) {
      if (!(depth > 0)) continue;
      ++found;
      EXPECT_NEAR(depth, f == 0 ? 1000 : 1040, 2);
    }
    EXPECT_GT(found, stream.scans[f].depth_mm.size() * 8 / 10);
    EXPECT_EQ(stream.scans[f].picture.channels, 1);
  }
}

TEST(DepthTake, NamesFringePicturesThatAreWrongAndKeepsTheRest) {
  FringeStream stream;
  for (const int n : {0, 1, 2, 3}) stream.fringes(n);
  stream.write("pattern/a/1/2.ppm", "P6 nonsense");
  stream.remove("pattern/a/2/4.pgm");
  stream.write("pattern/a/3/0.pgm", "P5 20 20 255\n" + std::string(400, 'x'));
  stream.write("pattern/a/3/7.pgm", "x");
  const DepthTakeResult result = stream.read();
  EXPECT_EQ(stream.ids, (std::vector<std::string>{"0"}));
  ASSERT_EQ(stream.heard.texts.size(), 4u);
  EXPECT_EQ(stream.heard.texts[0],
            "take a, file pattern/a/3/7.pgm: is no fringe picture like pattern/a/17/0.png to 4.png; left out");
  EXPECT_EQ(stream.heard.texts[1].substr(0, 35), "take a, frame 1: pattern/a/1/2.ppm ");
  EXPECT_EQ(stream.heard.texts[2], "take a, frame 2: it has no fringe picture 4, expected 0 to 4; left out");
  EXPECT_EQ(stream.heard.texts[3],
            "take a, frame 3: its fringe picture 1.pgm is 64 x 48 pixels, expected 20 x 20; left out");
  stream.remove("projector.json");
  EXPECT_EQ(why_nothing_is_left(stream),
            "take a: none of its 4 frames is left; frame 0: it has fringe pictures, but there is no projector.json "
            "beside camera.json; the take is left out");
}

TEST(DepthTake, RejectsAProjectorFileThatCannotBe) {
  const auto message = [](const std::string& json) {
    FringeStream stream;
    stream.fringes(0);
    stream.write("projector.json", json);
    return message_of([&] { stream.read(); });
  };
  EXPECT_EQ(message(R"({"fx": 2000, "cx": 511.5, "cy": 383.5})"),
            "projector.json: has no width, the pixels over which the fringes lie");
  EXPECT_EQ(message(R"({"fx": 2000, "fy": 1000, "cx": 511.5, "cy": 383.5, "width": 1024, "height": 768})"),
            "projector.json: fy is 0.5 times fx, expected pixels as high as wide");
  EXPECT_EQ(message(R"({"fx": 2000, "cx": 5, "cy": 3, "width": 1024, "height": 768, "fine_periods": 0})"),
            "projector.json at /fine_periods: found 0, expected more than 0");
  EXPECT_EQ(message(R"({"fx": 2000, "cx": 5, "cy": 3, "width": 1024, "height": 768, "near_mm": 2000})"),
            "projector.json: near_mm is 2000 and far_mm 1150, expected near_mm to be less");
}

TEST(DepthTake, SaysOnceWhatFramesInARowHaveWrong) {
  Stream stream;
  for (const int n : {1, 6, 7}) stream.frame(n);
  for (const int n : {2, 3, 4, 8}) stream.picture(std::to_string(n));
  const DepthTakeResult result = stream.read();
  EXPECT_EQ(stream.ids, (std::vector<std::string>{"1", "6", "7"}));
  EXPECT_EQ(result.dropped, 4);
  EXPECT_EQ(stream.heard.texts,
            (std::vector<std::string>{"take a, frames 2 to 4: it has a picture or mask but no depth; left out",
                                      "take a, frame 5 is missing",
                                      "take a, frame 8: it has a picture or mask but no depth; left out"}));
}

TEST(DepthTake, NamesWrongIntrinsics) {
  Stream stream(R"({"fx": 20, "cx": 31.5, "cy": 23.5, "depth_unit_mm": 0.1})");
  stream.frame(0);
  EXPECT_EQ(
      why_nothing_is_left(stream),
      "take a: none of its 1 frames is left; frame 0: what is measured is 1242 mm wide, expected 60 to 1200: are fx "
      "and the unit of depth those of this camera?; the take is left out");
  std::string xyz;
  for (int i = 0; i < width * height; ++i) {
    const double z = 0.1 * ball()[static_cast<std::size_t>(i)];
    xyz += std::to_string((i % width - 31.5) * z / 300) + " " + std::to_string((i / width - 23.5) * z / 300) + " " +
           std::to_string(z) + " 1 2 3\n";
  }
  Stream cloud;
  cloud.write("cloud/a/0.xyz", xyz);
  EXPECT_EQ(why_nothing_is_left(cloud),
            "take a: none of its 1 frames is left; frame 0: the intrinsics bring the points of cloud/a/0.xyz 4.2 px "
            "beside their "
            "pixels (median), expected at most 2: fx, fy, cx and cy are not those of this camera; the take is left "
            "out");
}

TEST(DepthTake, SaysWhichFileOfAFrameIsEmptyOrBroken) {
  Stream stream;
  for (const int n : {1, 2, 3}) stream.frame(n);
  stream.write("picture/a/2.pgm", "");
  stream.write("mask/a/3.pgm", "P5 nonsense");
  stream.read();
  EXPECT_EQ(stream.ids, (std::vector<std::string>{"1"}));
  ASSERT_EQ(stream.heard.texts.size(), 2u);
  EXPECT_EQ(stream.heard.texts[0], "take a, frame 2: picture/a/2.pgm: is empty, expected a picture; left out");
  EXPECT_EQ(stream.heard.texts[1].substr(0, 30), "take a, frame 3: mask/a/3.pgm ");
}

TEST(DepthTake, ReadsAMaskThatIsAColourPicture) {
  Stream stream;
  stream.frame(1);
  const std::vector<float> whole = (stream.read(), stream.scans[0].depth_mm);
  std::string mask = "P6 64 48 255\n";
  for (int i = 0; i < width * height; ++i) mask += i % width < 32 ? std::string(3, '\0') : std::string("\0\xff\0", 3);
  stream.write("mask/a/1.ppm", mask);
  stream.read();
  ASSERT_EQ(stream.scans.size(), 1u);
  for (int i = 0; i < width * height; ++i) {
    const auto p = static_cast<std::size_t>(i);
    EXPECT_EQ(stream.scans[0].depth_mm[p], i % width < 32 ? 0 : whole[p]);
  }
}

TEST(DepthTake, SaysThatAUnitIsNotGiven) {
  Stream stream(R"({"fx": 200, "cx": 31.5, "cy": 23.5, "rate_hz": 40})");
  stream.frame(0);
  EXPECT_EQ(why_nothing_is_left(stream),
            "take a: none of its 1 frames is left; frame 0: its median depth is 8442 mm, expected 150 to 4000: is the "
            "unit of depth 0.1 mm? camera.json has no depth_unit_mm, so that 1 mm is taken; the take is left out");
}

TEST(DepthTake, RejectsACameraFileThatCannotBe) {
  const auto message = [](const std::string& json) {
    Stream stream(json);
    stream.frame(0);
    return message_of([&] { stream.read(); });
  };
  EXPECT_EQ(message(R"({"cx": 1, "cy": 1})"), R"(camera.json: found {"cx":1,"cy":1}, expected an object with "fx")");
  EXPECT_EQ(message(R"({"fx": 500, "cx": 1, "cy": 1, "depth_units_mm": 0.1, "serial": 3})"),
            "camera.json at /depth_units_mm: no such key, expected \"depth_unit_mm\"");
  EXPECT_EQ(message(R"({"fx": -3, "cx": 1, "cy": 1})"),
            "camera.json: fx is -3 and fy -3 px, expected both more than 0");
  EXPECT_EQ(
      message(R"({"fx": 5, "cx": 1, "cy": 1, "width": 640, "height": 480})"),
      "camera.json: a focal length of 5 px over 640 px of width is a field of view of 178.2 degrees, expected 3 to "
      "150");
  EXPECT_EQ(message(R"({"fx": 500, "cx": 900, "cy": 1, "width": 640, "height": 480})"),
            "camera.json: the centre is at 900 px of width, expected a place in the picture, 0 to 639");
  EXPECT_EQ(message(R"({"fx": 500, "cx": 1, "cy": 1, "width": 640.5, "height": 480})"),
            "camera.json at /width: found 640.5, expected a whole number from 1 to 100000");
  EXPECT_EQ(message(R"({"fx": 500, "cx": 1, "cy": 1, "width": 640, "height": 1e30})"),
            "camera.json at /height: found 1e+30, expected a whole number from 1 to 100000");
  EXPECT_EQ(message(R"({"fx": 500, "cx": 1, "cy": 1, "mask_value": 0.5})"),
            "camera.json at /mask_value: found 0.5, expected a whole number from 1 to 65535");
  EXPECT_EQ(
      message(R"({"fx": 500, "cx": 1, "cy": 1, "cam_from_world": [1, 0, 0, 0, 1, 0, 0, 0, -1]})"),
      "camera.json at /cam_from_world: found a matrix that mirrors, expected a rotation (three rows of length 1 at "
      "right angles to each other)");
  EXPECT_EQ(
      message(R"({"fx": 500, "cx": 1, "cy": 1, "cam_from_world": [0, 0, 0, 0, 0, 0, 0, 0, 0]})"),
      "camera.json at /cam_from_world: found a matrix that stretches or shears, expected a rotation (three rows of "
      "length 1 at right angles to each other)");
  EXPECT_EQ(message(R"({"fx": 500, "cx": 1, "cy": 1, "distortion": [0, 0.1]})"),
            "camera.json at /distortion: found [0,0.1], expected zeros: undistort depth and pictures first");
  EXPECT_EQ(message(R"({"fx": 500, "cx": 1, "cy": 1, "depth_scale": 0.001})"),
            "camera.json at /depth_scale: some programs mean metres per unit by it and some units per metre; expected "
            "\"depth_unit_mm\", the mm of one unit");
}

TEST(DepthTake, RejectsAFolderWithoutCameraOrFrames) {
  Stream stream;
  EXPECT_NE(message_of([&] { stream.read(); }).find(": has no files of take a below depth, cloud or pattern"),
            std::string::npos);
  engine::SeqWriter<DepthScan> none([](std::string, DepthScan) {});
  engine::Progress quiet;
  EXPECT_THROW_TEXT(depth_take(engine::File::folder("/x/stream", {}), "a", none, {}, quiet),
                    "stream: has no camera.json, which says fx, fy, cx and cy");
}
