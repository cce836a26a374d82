// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "nodes/render/draw_landmarks.h"
#include "nodes/render/make_contact_sheet.h"
#include "nodes/render/pick_key_frames.h"
#include "nodes/render/render_sheet.h"
#include "tests/nodes/render/test_ball.h"
#include "tests/support/expect_throw_text.h"

namespace face::render {
namespace {

Image plain(int width, int height, std::uint8_t value, int channels = 3) {
  return {width, height, channels,
          std::vector<std::uint8_t>(static_cast<std::size_t>(width * height * channels), value)};
}

Timeline at_60_hz(std::size_t frames) {
  Timeline timeline;
  for (std::size_t i = 0; i < frames; ++i) timeline.time_s.push_back(static_cast<double>(i) / 60);
  timeline.duration_s = static_cast<double>(frames) / 60;
  return timeline;
}

// Phones of 0.1 s each.
Phones spoken(const std::vector<std::string>& labels) {
  Phones phones;
  for (const std::string& label : labels) {
    phones.phones.push_back({label, phones.duration_s, phones.duration_s + 0.1, label == "SIL" ? "" : "word", 0});
    phones.duration_s += 0.1;
  }
  return phones;
}

TEST(PickKeyFrames, TakesTheMiddlesOfPhonesInOrder) {
  const Phones phones = spoken({"SIL", "P.c", "P.r", "AA", "M", "SIL"});
  const std::vector<KeyFrame> keys = pick_key_frames(phones, at_60_hz(36), 10);
  ASSERT_EQ(keys.size(), 4u);  // no silence
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(keys[i].phone, i + 1);
    EXPECT_EQ(keys[i].frame, 9 + 6 * i);  // 0.15 s and so on
  }
}

TEST(PickKeyFrames, PrefersClosuresAndVowelsAndVariety) {
  const Phones phones = spoken({"AA", "N", "AA", "T.r", "AA", "B.c", "AA", "IY", "K.r"});
  const std::vector<KeyFrame> keys = pick_key_frames(phones, at_60_hz(54), 3);
  ASSERT_EQ(keys.size(), 3u);
  std::vector<std::string> labels;
  for (const KeyFrame& key : keys) labels.push_back(phones.phones[key.phone].label);
  EXPECT_EQ(labels, (std::vector<std::string>{"AA", "B.c", "IY"}));
}

TEST(PickKeyFrames, ShowsSilenceWhereThereIsNothingElse) {
  EXPECT_EQ(pick_key_frames(spoken({"SIL"}), at_60_hz(6), 5).size(), 1u);
  EXPECT_TRUE(pick_key_frames(Phones{}, at_60_hz(6), 5).empty());
  EXPECT_TRUE(pick_key_frames(spoken({"AA"}), Timeline{}, 5).empty());
}

TEST(PickKeyFrames, TakesNoFrameTwice) {
  Phones phones = spoken({"AA", "B", "IY", "M"});
  for (Phone& phone : phones.phones) {
    phone.start_s /= 100;
    phone.end_s /= 100;
  }
  EXPECT_EQ(pick_key_frames(phones, at_60_hz(3), 10).size(), 1u);
}

TEST(MakeContactSheet, LaysPicturesOutInRows) {
  const Image sheet = make_contact_sheet({plain(30, 20, 200), plain(30, 20, 100), plain(30, 20, 50)}, {}, 2);
  EXPECT_EQ(sheet.width, 2 * 30 + 3 * 4);
  EXPECT_EQ(sheet.height, 2 * 20 + 3 * 4);
  const auto at = [&](int x, int y) { return int{sheet.pixels[static_cast<std::size_t>((y * sheet.width + x) * 3)]}; };
  EXPECT_EQ(at(4, 4), 200);
  EXPECT_EQ(at(33, 23), 200);
  EXPECT_EQ(at(38, 4), 100);
  EXPECT_EQ(at(4, 28), 50);
  EXPECT_EQ(at(38, 28), at(0, 0));  // nothing there
}

TEST(MakeContactSheet, WritesTheCaptionUnderItsPicture) {
  const Image without = make_contact_sheet({plain(120, 120, 0), plain(120, 120, 0)}, {Caption{}}, 2);
  const Image with = make_contact_sheet({plain(120, 120, 0), plain(120, 120, 0)}, {Caption{"AA", "father"}}, 2);
  ASSERT_EQ(with.height, without.height);
  EXPECT_GT(with.height, 120 + 8);
  for (int y = 0; y < with.height; ++y)
    for (int x = 0; x < with.width; ++x) {
      const auto index = static_cast<std::size_t>((y * with.width + x) * 3);
      if (with.pixels[index] != without.pixels[index]) {
        EXPECT_GE(y, 124);
        EXPECT_LT(x, 124);
      }
    }
  EXPECT_NE(with.pixels, without.pixels);
}

TEST(MakeContactSheet, RejectsWhatDoesNotFitTogether) {
  EXPECT_THROW_TEXT(make_contact_sheet({}, {}, 2), "there are no pictures for the sheet");
  EXPECT_THROW_TEXT(make_contact_sheet({plain(3, 3, 0)}, {}, 0), "columns is 0, expected at least 1");
  EXPECT_THROW_TEXT(make_contact_sheet({plain(3, 3, 0), plain(3, 4, 0)}, {}, 2),
                    "picture 1 is 3 x 4, but picture 0 is 3 x 3");
  EXPECT_THROW_TEXT(make_contact_sheet({plain(3, 3, 0)}, {Caption{}, Caption{}}, 2),
                    "there are 2 captions for 1 pictures");
}

TEST(RenderSheet, RendersOnlyTheFramesItShows) {
  class Counted final : public engine::SeqSource<Weights> {
   public:
    std::size_t size() const override { return 600; }
    std::string id(std::size_t index) const override { return std::to_string(index); }
    std::shared_ptr<const Weights> load(std::size_t) const override {
      ++loads;
      return std::make_shared<Weights>();
    }
    mutable int loads = 0;
  };
  const auto source = std::make_shared<Counted>();
  RenderSheetOptions options;
  options.pictures = 5;
  options.columns = 3;
  options.picture_px = 64;
  Phones phones = spoken({"SIL", "AA", "B.c", "B.r", "IY", "M", "OW", "F", "S", "T.c"});
  const Image sheet = render_sheet(test::ball_rig(80), engine::Seq<Weights>(source), at_60_hz(600), phones, options);
  EXPECT_EQ(source->loads, 5);
  EXPECT_EQ(sheet.width, 3 * 64 + 4 * 4);
}

TEST(RenderSheet, ShowsTheFirstFrameWhereNothingIsSaid) {
  RenderSheetOptions options;
  options.picture_px = 64;
  const Image sheet =
      render_sheet(test::ball_rig(80), engine::Seq<Weights>({Weights{}}), at_60_hz(1), Phones{}, options);
  EXPECT_EQ(sheet.width, 64 + 8);
  EXPECT_THROW_TEXT(render_sheet(test::ball_rig(80), {}, {}, Phones{}), "there are no frames for the sheet");
  EXPECT_THROW_TEXT(render_sheet(test::ball_rig(80), engine::Seq<Weights>({Weights{}}), at_60_hz(2), Phones{}),
                    "there are 1 frames, but the timeline has 2 times");
}

TEST(DrawLandmarks, MarksTrackedPointsGreenAndLostOnesRed) {
  const Landmarks landmarks{{{"a", 10, 10, true}, {"b", 30, 10, false}, {"out", 500, 10, true}, {"edge", 0, 0, true}}};
  const Image image = draw_landmarks(plain(40, 20, 128), landmarks);
  const auto at = [&](int x, int y, int c) {
    return int{image.pixels[static_cast<std::size_t>((y * 40 + x) * 3 + c)]};
  };
  EXPECT_GT(at(10, 10, 1), at(10, 10, 0) + 100);
  EXPECT_EQ(at(30, 10, 0), 128);  // a ring: its middle shows the frame
  EXPECT_GT(at(32, 10, 0), at(32, 10, 1) + 40);
  EXPECT_EQ(at(20, 10, 0), 128);
  EXPECT_GT(at(0, 0, 1), at(0, 0, 0) + 100);
}

TEST(DrawLandmarks, TurnsGreyAndTransparentFramesIntoRgb) {
  for (const int channels : {1, 4}) {
    const Image image = draw_landmarks(plain(8, 6, 77, channels), {});
    EXPECT_EQ(image.channels, 3);
    EXPECT_EQ(image.pixels, plain(8, 6, 77).pixels);
  }
}

TEST(DrawLandmarks, RejectsWhatIsNoImage) {
  EXPECT_THROW_TEXT(draw_landmarks(Image{2, 2, 3, {}}, {}), "the image has 0 bytes, expected 12 for 2 x 2 x 3");
  EXPECT_THROW_TEXT(draw_landmarks(plain(2, 2, 0), {}, {0}), "radius_px is 0, expected more than 0");
}

}  // namespace
}  // namespace face::render
