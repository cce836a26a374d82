// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_video.h"

#include <sndfile.h>

#include "tests/nodes/decode/temporary.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::decode;

namespace {

struct Film {
  std::vector<Image> frames;
  std::vector<std::string> ids;
  ReadVideoResult result;
};

Film read(const std::string& path) {
  Film film;
  engine::SeqWriter<Image> writer([&](std::string id, Image image) {
    film.ids.push_back(std::move(id));
    film.frames.push_back(std::move(image));
  });
  engine::Progress progress;
  film.result = read_video(engine::File::at(path), writer, progress);
  return film;
}

}  // namespace

TEST(ReadVideo, ReadsAllFramesOfAClipInOrder) {
  for (const char* clip : {"bbaf2n", "brbk7n", "lbax4n", "lrwp9a", "pwij3p", "swwp2s"}) {
    DATA_FILE(path, std::string("grid/") + clip + ".mpg");
    const Film film = read(path);
    ASSERT_EQ(film.frames.size(), 75u) << clip;
    EXPECT_EQ(film.ids.front(), "0");
    EXPECT_EQ(film.ids.back(), "74");
    EXPECT_EQ(film.frames[0].width, 360);
    EXPECT_EQ(film.frames[0].height, 288);
    EXPECT_EQ(film.frames[0].pixels.size(), 360u * 288 * 3);
    ASSERT_EQ(film.result.timeline.time_s.size(), 75u);
    for (std::size_t i = 0; i < 75; ++i) EXPECT_NEAR(film.result.timeline.time_s[i], static_cast<double>(i) / 25, 1e-3);
    EXPECT_NEAR(film.result.rate_hz, 25, 0.01);
    EXPECT_NEAR(film.result.timeline.duration_s, 3, 1e-3);
  }
}

TEST(ReadVideo, GivesTheSamePixelsTwice) {
  DATA_FILE(path, "grid/bbaf2n.mpg");
  const Film a = read(path), b = read(path);
  for (std::size_t i = 0; i < a.frames.size(); ++i) ASSERT_EQ(a.frames[i].pixels, b.frames[i].pixels) << i;
}

TEST(ReadVideo, ShowsColoursAsTheyAre) {
  DATA_FILE(path, "grid/bbaf2n.mpg");
  const Image image = read(path).frames[0];
  const auto pixel = [&](int x, int y) { return &image.pixels[static_cast<std::size_t>((y * image.width + x) * 3)]; };
  const auto *cheek = pixel(130, 200), *wall = pixel(20, 60);
  EXPECT_GT(cheek[0], cheek[2] + 30);  // skin: more red than blue
  EXPECT_GT(wall[2], wall[0] + 30);    // the studio's blue wall
}

TEST(ReadVideo, RejectsAMissingAndAnEmptyFile) {
  EXPECT_THROW_TEXT(read("/nowhere/clip.mpg"), "clip.mpg: cannot be opened: No such file or directory");
  const test::Temporary temporary;
  EXPECT_THROW_TEXT(read(temporary.write("clip.mpg", "")), "clip.mpg: is empty (0 bytes), expected a video file");
}

TEST(ReadVideo, RejectsWhatIsNoVideo) {
  const test::Temporary temporary;
  EXPECT_THROW_TEXT(
      read(temporary.write("clip.mp4", "This is a text.")),
      "clip.mp4: cannot be read: Invalid data found when processing input; expected a video file (MP4, MOV, MPEG, "
      "AVI, MKV, WebM)");
}

// A grey JPEG of 16 x 8 pixels, its left half light, with an orientation as cameras write it (EXIF 2.3, tag 0x0112).
// The coefficients are coded by the tables of the standard's annex K.3, which decoders have.
std::string photograph(char orientation) {
  using namespace std::string_literals;
  return "\xFF\xD8\xFF\xE1\0\x22"s + "Exif\0\0MM\0*\0\0\0\x08\0\1\1\x12\0\3\0\0\0\1\0"s + orientation +
         "\0\0\0\0\0\0\xFF\xDB\0\x43\0"s + std::string(64, 8) + "\xFF\xC0\0\x0B\x08\0\x08\0\x10\1\1\x11\0"s +
         "\xFF\xDA\0\x08\1\1\0\0\x3F\0\xF6\x4A\xF8\xDE\xBF\xFF\xD9"s;
}

TEST(ReadVideo, TurnsAPhotographUprightAsItsCameraSays) {
  const test::Temporary temporary;
  struct Shown {
    int width, height, light_x, light_y;  // of the middle of the light half
  };
  // Orientations 1 to 8: as stored, mirrored, half a turn, upside down, and the same with rows and columns exchanged.
  const Shown all[] = {{16, 8, 4, 4}, {16, 8, 12, 4}, {16, 8, 12, 4}, {16, 8, 4, 4},
                       {8, 16, 4, 4}, {8, 16, 4, 4},  {8, 16, 4, 12}, {8, 16, 4, 12}};
  for (char orientation = 1; orientation <= 8; ++orientation) {
    const Shown& shown = all[orientation - 1];
    const Film film = read(temporary.write("photograph.jpg", photograph(orientation)));
    ASSERT_EQ(film.frames.size(), 1u);
    const Image& image = film.frames[0];
    const auto level = [&](int x, int y) { return image.pixels[static_cast<std::size_t>((y * image.width + x) * 3)]; };
    EXPECT_EQ(image.width, shown.width) << int{orientation};
    EXPECT_EQ(image.height, shown.height) << int{orientation};
    EXPECT_EQ(level(shown.light_x, shown.light_y), 228) << int{orientation};
    EXPECT_EQ(level(shown.width - 1 - shown.light_x, shown.height - 1 - shown.light_y), 28) << int{orientation};
  }
}

TEST(ReadVideo, RejectsAPhotographThatIsCutOff) {
  const test::Temporary temporary;
  const std::string whole = photograph(1);
  // In its tables, and in the middle of its pixels, which decoders would fill with grey.
  EXPECT_THROW_TEXT(read(temporary.write("photograph.jpg", whole.substr(0, 80))),
                    "photograph.jpg: is cut short: its 80 bytes hold no end of the JPEG picture");
  EXPECT_THROW_TEXT(read(temporary.write("photograph.jpg", whole.substr(0, whole.size() - 3))),
                    "photograph.jpg: is cut short: its 134 bytes hold no end of the JPEG picture");
}

TEST(ReadVideo, DoesNotTakeTheEndOfAThumbnailForThePhotographs) {
  using namespace std::string_literals;
  const test::Temporary temporary;
  std::string whole = photograph(1);
  whole.insert(2, "\xFF\xE2\0\x06\xFF\xD8\xFF\xD9"s);
  EXPECT_EQ(read(temporary.write("photograph.jpg", whole)).frames.size(), 1u);
  EXPECT_THROW_TEXT(read(temporary.write("photograph.jpg", whole.substr(0, whole.size() - 3))),
                    "photograph.jpg: is cut short: its 142 bytes hold no end of the JPEG picture");
}

TEST(ReadVideo, RejectsARecordingWithoutPictures) {
  const test::Temporary temporary;
  SF_INFO info{};
  info.samplerate = 16000, info.channels = 1, info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
  SNDFILE* out = sf_open(temporary.path("line.wav").c_str(), SFM_WRITE, &info);
  const std::vector<float> samples(1600);
  sf_writef_float(out, samples.data(), 1600);
  sf_close(out);
  EXPECT_THROW_TEXT(
      read(temporary.path("line.wav")),
      "line.wav: has no pictures: found audio pcm_s16le, expected a video file (MP4, MOV, MPEG, AVI, MKV, WebM)");
}

TEST(ReadVideo, ReadsTheFramesThatATruncatedMpegHasOrSaysSo) {
  DATA_FILE(path, "grid/bbaf2n.mpg");
  const test::Temporary temporary;
  const std::string whole = test::bytes_of(path);
  // A program stream has no table of contents: what is there is a shorter film. Whatever comes back is whole frames.
  const Film film = read(temporary.write("half.mpg", whole.substr(0, whole.size() / 2)));
  EXPECT_GT(film.frames.size(), 20u);
  EXPECT_LT(film.frames.size(), 75u);
  for (const Image& image : film.frames) EXPECT_EQ(image.pixels.size(), 360u * 288 * 3);
}
