// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/inner_lips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/nodes/track/drawn_mouth.h"
#include "tests/nodes/track/grid_clip.h"
#include "tests/nodes/track/lips_in.h"
#include "tests/nodes/track/phantom_clip.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using Mouth = test::DrawnMouth;

namespace {

double gap_px(const Landmarks& points, int column) {
  return test::point_of(points, "inner_lip_" + std::to_string(8 - column)).y_px -
         test::point_of(points, "inner_lip_" + std::to_string(column)).y_px;
}

}  // namespace

TEST(InnerLips, AHollowIsFoundWhereItBeginsAndEnds) {
  const Mouth mouth{5, 9};
  const Landmarks found = test::inner_lips_in(mouth.image(), mouth.outer());
  ASSERT_EQ(found.points.size(), 18u);
  for (int column = 1; column <= 3; ++column) {
    EXPECT_NEAR(test::point_of(found, "inner_lip_" + std::to_string(column)).y_px, 35, 1) << column;
    EXPECT_NEAR(test::point_of(found, "inner_lip_" + std::to_string(8 - column)).y_px, 48.5, 1) << column;
  }
}

TEST(InnerLips, TeethAreNoLips) {
  const Mouth mouth{6, 4, test::tooth};
  const Landmarks found = test::inner_lips_in(mouth.image(), mouth.outer());
  EXPECT_NEAR(gap_px(found, 2), 10, 1.5);
}

TEST(InnerLips, ShutLipsHaveNoGap) {
  const Mouth mouth;
  const Landmarks found = test::inner_lips_in(mouth.image(), mouth.outer());
  for (int column = 1; column <= 3; ++column) EXPECT_NEAR(gap_px(found, column), 0, 0.5) << column;
}

TEST(InnerLips, ShutLipsThatAreGlossyOrInTheShadeHaveNoGap) {
  const Mouth shut, open{6, 4, test::tooth};
  for (int column = 1; column <= 3; ++column) {
    EXPECT_NEAR(gap_px(test::inner_lips_in(test::glossy(shut), shut.outer()), column), 0, 0.5) << column;
    EXPECT_NEAR(gap_px(test::inner_lips_in(test::glossy(open), open.outer()), column), 10, 2.5) << column;
  }
}

// A mouth's points with three that do not move with it.
Landmarks with_head(Landmarks mouth) {
  mouth.points.insert(mouth.points.begin(),
                      {{"eye_inner_r", 45, -40, true}, {"eye_inner_l", 75, -40, true}, {"nose_tip", 60, 5, true}});
  return mouth;
}

// Its lips, 16 px thick each, meet in a dark seam.
const Mouth resting{1, 1};
Landmarks shut_mouth() { return test::inner_lips_in(resting.image(), with_head(resting.outer())); }

TEST(InnerLips, ATongueLikeALipIsToldByHowThickTheLipsAreAtRest) {
  const Mouth mouth{8, 8, test::lower_lip};
  const Landmarks rest = shut_mouth(), outer = with_head(mouth.outer());
  EXPECT_LT(gap_px(test::inner_lips_in(mouth.image(), outer), 2), 3);
  EXPECT_NEAR(gap_px(test::inner_lips_in(mouth.image(), outer, &rest), 2), 16, 5)
      << "that it is like a lip counts a little";
}

TEST(InnerLips, LipsOfANarrowerMouthAreThicker) {
  const Mouth mouth{5, 5, test::lower_lip};  // a third thicker than at rest, or open
  const Landmarks rest = shut_mouth(), outer = with_head(mouth.outer());
  Landmarks wide = rest;
  for (Landmark& p : wide.points)
    if (p.name.starts_with("lip_")) p.x_px = 60 + 1.3 * (p.x_px - 60);
  const double open_px = gap_px(test::inner_lips_in(mouth.image(), outer, &rest), 2);
  EXPECT_GT(open_px, 5);
  EXPECT_LT(gap_px(test::inner_lips_in(mouth.image(), outer, &wide), 2), open_px - 4);
  track::InnerLipsOptions options;
  options.thickening = 0;
  EXPECT_EQ(gap_px(test::inner_lips_in(mouth.image(), outer, &wide, nullptr, nullptr, options), 2), open_px);
}

TEST(InnerLips, WhatIsSeenCountsMoreThanTheThicknessAtRest) {
  const Mouth mouth{6, 9, test::tooth};  // the upper lip is 19 px thick, the lower 16
  const Landmarks rest = shut_mouth();
  const Landmarks found = test::inner_lips_in(mouth.image(), with_head(mouth.outer()), &rest);
  EXPECT_NEAR(gap_px(found, 2), 15, 1.5);
  EXPECT_NEAR(test::point_of(found, "inner_lip_2").y_px, 34, 1.5);
}

TEST(InnerLips, LipsThatAreThickAsAtRestAreShutAtAnyScale) {
  Landmarks rest = shut_mouth();
  EXPECT_NEAR(gap_px(rest, 2), 1.5, 1);
  for (Landmark& p : rest.points) p.x_px = 300 + p.x_px / 2, p.y_px = 200 + p.y_px / 2;
  const Mouth open{8, 8, test::lower_lip};
  EXPECT_NEAR(gap_px(test::inner_lips_in(resting.image(), with_head(resting.outer()), &rest), 2), 1.5, 1);
  EXPECT_NEAR(gap_px(test::inner_lips_in(open.image(), with_head(open.outer()), &rest), 2), 16, 5);
}

// A head that turns aside shows its mouth half as wide: that is no pout.
TEST(InnerLips, LipsOfAHeadThatTurnsAreAsThickAsAtRest) {
  const Mouth mouth{8, 8, test::lower_lip};
  const Landmarks rest = shut_mouth();
  Landmarks outer = with_head(mouth.outer());
  for (Landmark& p : outer.points) p.x_px = 60 + 0.5 * (p.x_px - 60);
  Image image = mouth.image();
  const Image front = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        image.pixels[static_cast<std::size_t>((y * image.width + x) * 3 + c)] = front.pixels[static_cast<std::size_t>(
            (y * image.width + std::clamp(60 + 2 * (x - 60), 0, image.width - 1)) * 3 + c)];
  const Matrix depths{rest.points.size(), 1, std::vector<double>(rest.points.size(), 0.0)};
  const Matrix head{7, 1, {0, std::acos(0.5), 0, 0, 0, 0, 1}};
  EXPECT_LT(gap_px(test::inner_lips_in(image, outer, &rest), 2), 8);
  EXPECT_NEAR(gap_px(test::inner_lips_in(image, outer, &rest, &depths, &head), 2), 16, 5);
  const Matrix unseen{7, 1, {0, std::acos(0.5), 0, 0, 0, 0, 0}};
  EXPECT_EQ(gap_px(test::inner_lips_in(image, outer, &rest, &depths, &unseen), 2),
            gap_px(test::inner_lips_in(image, outer, &rest), 2));
}

TEST(InnerLips, ARestThatDoesNotSayHowThickTheLipsAreIsNone) {
  const Mouth mouth{5, 9};
  const Landmarks outer = mouth.outer();
  EXPECT_EQ(gap_px(test::inner_lips_in(mouth.image(), outer, &outer), 2),
            gap_px(test::inner_lips_in(mouth.image(), outer), 2));
}

TEST(InnerLips, LightThatIsHalfAsBrightChangesLittle) {
  const Mouth mouth{5, 9};
  Image dim = mouth.image();
  for (std::uint8_t& value : dim.pixels) value = static_cast<std::uint8_t>(value * 6 / 10);
  EXPECT_NEAR(gap_px(test::inner_lips_in(dim, mouth.outer()), 2),
              gap_px(test::inner_lips_in(mouth.image(), mouth.outer()), 2), 1);
}

TEST(InnerLips, APointIsLostWithThoseOfItsLine) {
  const Mouth mouth{5, 9};
  Landmarks outer = mouth.outer();
  outer.points[3].valid = false;
  const Landmarks found = test::inner_lips_in(mouth.image(), outer);
  EXPECT_FALSE(test::point_of(found, "inner_lip_2").valid);
  EXPECT_FALSE(test::point_of(found, "inner_lip_6").valid);
  EXPECT_TRUE(test::point_of(found, "inner_lip_1").valid);
}

TEST(InnerLips, PointsOutsideThePictureAreNoMisfortune) {
  const Mouth mouth{5, 9};
  Landmarks outer = mouth.outer();
  for (Landmark& point : outer.points) point.x_px += 500;
  EXPECT_EQ(test::inner_lips_in(mouth.image(), outer).points.size(), 18u);
}

TEST(InnerLips, WantTheLipsOfTheLayout) {
  const Mouth mouth;
  Landmarks outer = mouth.outer();
  outer.points.erase(outer.points.begin() + 3);
  EXPECT_THROW_TEXT(test::inner_lips_in(mouth.image(), outer),
                    "there is no landmark lip_3: the lips' points are lip_0 to lip_11");
  outer = test::inner_lips_in(mouth.image(), mouth.outer());
  EXPECT_THROW_TEXT(test::inner_lips_in(mouth.image(), outer), "there is a landmark inner_lip_1 already");
}

// What opens between the phantom's lips, from the true outer points.
TEST(InnerLips, FollowThePhantomsMouth) {
  const test::PhantomClip clip = test::film_phantom("Bob may move five warm loaves.", 60, test::Dots::none);
  std::vector<double> found, truth;
  for (std::size_t i = 0; i < clip.frames.size(); i += 2) {
    found.push_back(gap_px(test::inner_lips_in(*clip.frames[i], clip.truth[i]), 2));
    truth.push_back(clip.inner_gap_px[i]);
  }
  double sum_f = 0, sum_t = 0, ff = 0, tt = 0, ft = 0;
  const auto n = static_cast<double>(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    sum_f += found[i], sum_t += truth[i];
    ff += found[i] * found[i], tt += truth[i] * truth[i], ft += found[i] * truth[i];
  }
  const double correlation = (ft - sum_f * sum_t / n) / std::sqrt((ff - sum_f * sum_f / n) * (tt - sum_t * sum_t / n));
  std::printf("r %.3f, %.2f px wide on average, truth %.2f\n", correlation, sum_f / n, sum_t / n);
  EXPECT_GE(correlation, 0.97);
}

// A clip of low contrast left the mouth nearly shut, one of high contrast open where it was shut.
TEST(InnerLips, OpenAsFarInAPictureOfAnyContrast) {
  const test::PhantomClip clip = test::film_phantom("Bob may move five warm loaves.", 60, test::Dots::none);
  for (const auto& [gain, offset] : {std::pair{0.35, 90.0}, {0.5, 0.0}, {0.7, 60.0}, {1.2, -15.0}}) {
    double plain_px = 0, changed_px = 0, apart = 0, count = 0;
    for (std::size_t i = 0; i < clip.frames.size(); i += 2, ++count) {
      Image changed = *clip.frames[i];
      for (std::uint8_t& value : changed.pixels)
        value = static_cast<std::uint8_t>(std::clamp(gain * value + offset + 0.5, 0.0, 255.0));
      const double plain = gap_px(test::inner_lips_in(*clip.frames[i], clip.truth[i]), 2);
      const double other = gap_px(test::inner_lips_in(changed, clip.truth[i]), 2);
      plain_px += plain, changed_px += other, apart += (other - plain) * (other - plain);
    }
    std::printf("%.2f v + %.0f: %.2f px, plain %.2f, %.2f apart\n", gain, offset, changed_px / count, plain_px / count,
                std::sqrt(apart / count));
    EXPECT_NEAR(changed_px / plain_px, 1, 0.1) << gain;
    EXPECT_LE(std::sqrt(apart / count), 1.5) << gain;
  }
}

// The end of each clip: the sentence is over and the mouth shut.
TEST(InnerLips, OfRealMouthsAreTogetherAfterTheSentence) {
  DATA_FILE(data, "grid");
  for (const char* clip : test::grid_clips) {
    const auto frames = test::read_frames(data + "/" + clip + ".mpg");
    const auto start = decode::read_landmarks(engine::File::at(data + "/" + clip + ".landmarks.json")).landmarks;
    const auto tracked = test::track_frames(frames, start);
    double widest = 0, shut = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const double gap = gap_px(test::inner_lips_in(*frames[i], tracked[i].landmarks), 2);
      widest = std::max(widest, gap);
      if (i + 5 >= frames.size()) shut = std::max(shut, gap);
    }
    EXPECT_LE(shut, 2.5) << clip;
    EXPECT_GE(widest, 5) << clip;
  }
}
