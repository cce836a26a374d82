// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_key_frames.h"

#include <gtest/gtest.h>

#include "nodes/decode/read_video.h"
#include "nodes/export/mp4_writer.h"
#include "tests/nodes/decode/temporary.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::decode;

namespace {

struct Film {
  std::vector<Image> frames;
  std::vector<std::string> ids;
  Timeline timeline;
};

Film read_all(const std::string& path) {
  Film film;
  engine::SeqWriter<Image> writer([&](const std::string& id, Image image) {
    film.ids.push_back(id);
    film.frames.push_back(std::move(image));
  });
  engine::Progress progress;
  film.timeline = read_video(engine::File::at(path), writer, progress).timeline;
  return film;
}

Film read_some(const std::string& path, const Timeline& timeline, const std::vector<std::string>& wanted) {
  KeyShapes keys;
  for (const std::string& frame : wanted) keys.shapes.push_back({frame, 1, {}});
  Film film;
  engine::SeqWriter<Image> writer([&](const std::string& id, Image image) {
    film.ids.push_back(id);
    film.frames.push_back(std::move(image));
  });
  engine::Progress progress;
  read_key_frames(engine::File::at(path), timeline, keys, writer, progress);
  return film;
}

constexpr std::size_t film_frames = 200;

// A bar that moves over noise, with a key frame every two seconds, 60 frames.
void write_film(const std::string& path, int quality) {
  exports::Mp4Writer::Settings settings;
  settings.width_px = 64, settings.height_px = 48, settings.mean_rate_hz = 30;
  settings.quality = quality, settings.path = path;
  exports::Mp4Writer writer(settings);
  std::uint32_t state = 1;
  for (std::size_t i = 0; i < film_frames; ++i) {
    Image image{64, 48, 3, {}};
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x)
        for (int c = 0; c < 3; ++c) {
          state = state * 1664525 + 1013904223;
          const bool bar = static_cast<std::size_t>(x) / 4 == i % 16;
          image.pixels.push_back(static_cast<std::uint8_t>((bar ? 180 : 40 + 20 * c) + (state >> 28)));
        }
    const auto place = static_cast<double>(i);
    writer.add_picture(image, place / 30, (place + 1) / 30);
  }
  writer.finish();
}

void expect_same(const Film& some, const Film& all, const std::vector<std::size_t>& numbers) {
  ASSERT_EQ(some.ids.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    EXPECT_EQ(some.ids[i], all.ids[numbers[i]]);
    EXPECT_EQ(some.frames[i].pixels, all.frames[numbers[i]].pixels) << numbers[i];
  }
}

}  // namespace

TEST(ReadKeyFrames, AreThoseOfTheWholeFilm) {
  const test::Temporary temporary;
  for (const int quality : {0, 20}) {
    const std::string path = temporary.path("film" + std::to_string(quality) + ".mp4");
    write_film(path, quality);
    const Film all = read_all(path);
    ASSERT_EQ(all.frames.size(), film_frames);
    expect_same(read_some(path, all.timeline, {"131", "0", "61", "59", "60", "199", "130", "59"}), all,
                {0, 59, 60, 61, 130, 131, 199});
    for (std::size_t i = 0; i < film_frames; i += 7)
      expect_same(read_some(path, all.timeline, {std::to_string(i)}), all, {i});
  }
}

TEST(ReadKeyFrames, NothingElseIsDecoded) {
  const test::Temporary temporary;
  const std::string path = temporary.path("film.mp4");
  write_film(path, 0);
  const Film all = read_all(path);
  std::string bytes = test::bytes_of(path);
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() * 4 / 10), bytes.size() / 10, '\0');
  const std::string damaged = temporary.write("damaged.mp4", bytes);
  expect_same(read_some(damaged, all.timeline, {"5", "190"}), all, {5, 190});
}

TEST(ReadKeyFrames, AreToldByTheirNumberWhereTimesSayNothing) {
  const test::Temporary temporary;
  const std::string path = temporary.path("film.mp4");
  write_film(path, 20);
  Film all = read_all(path);
  for (double& time_s : all.timeline.time_s) time_s += 1;  // of a film that has lost its first 30
  expect_same(read_some(path, all.timeline, {"3", "100", "150"}), all, {3, 100, 150});
}

TEST(ReadKeyFrames, OfAFilmThatCannotBeSoughtInAreRead) {
  DATA_FILE(path, "grid/bbaf2n.mpg");
  const Film all = read_all(path);
  expect_same(read_some(path, all.timeline, {"70", "2", "33"}), all, {2, 33, 70});
}

TEST(ReadKeyFrames, OfNoKeyShapesAreNone) { EXPECT_TRUE(read_some("/nowhere/clip.mp4", {}, {}).frames.empty()); }

TEST(ReadKeyFrames, RejectsAFrameThatTheFilmHasNot) {
  const test::Temporary temporary;
  const std::string path = temporary.path("film.mp4");
  write_film(path, 20);
  Timeline timeline = read_all(path).timeline;
  EXPECT_THROW_TEXT(read_some(path, timeline, {"200"}), "key shape 200 is no frame of the video: the timeline has 200");
  EXPECT_THROW_TEXT(read_some(path, timeline, {"7a"}), "key shape 7a is no frame of the video: the timeline has 200");
  timeline.time_s.push_back(7);
  EXPECT_THROW_TEXT(read_some(path, timeline, {"200"}), "film.mp4: holds 200 frames, the timeline has 201");
}
