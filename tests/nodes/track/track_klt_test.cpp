// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/track_klt.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/base/random.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::track;

namespace {

// A smooth texture that is known everywhere: a sum of waves of 8 to 40 pixels.
class Texture {
 public:
  Texture() {
    Random random(1);
    for (int i = 0; i < 24; ++i) {
      const double length_px = random.uniform(8, 40), angle = random.uniform(0, 2 * M_PI);
      waves_.push_back(
          {2 * M_PI / length_px * std::cos(angle), 2 * M_PI / length_px * std::sin(angle), random.uniform(0, 6.3)});
    }
  }
  double at(double x, double y) const {
    double sum = 0;
    for (const Wave& w : waves_) sum += std::cos(w.x * x + w.y * y + w.phase);
    return 128 + 14 * sum;
  }

 private:
  struct Wave {
    double x, y, phase;
  };
  std::vector<Wave> waves_;
};

// The texture moved by (dx, dy) and turned about the image's centre; brightness is scaled.
std::shared_ptr<const Image> picture(double dx, double dy, double angle = 0, double gain = 1) {
  static const Texture texture;
  Image image{160, 120, 3, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double u = x - dx - 80, v = y - dy - 60;
      const double value = gain * texture.at(80 + std::cos(angle) * u + std::sin(angle) * v,
                                             60 - std::sin(angle) * u + std::cos(angle) * v);
      for (int c = 0; c < 3; ++c)
        image.pixels.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))));
    }
  return std::make_shared<const Image>(std::move(image));
}

Landmarks points() {
  Landmarks out;
  for (int i = 0; i < 12; ++i)
    out.points.push_back({"p" + std::to_string(i), 40.0 + 25 * (i % 4) + 0.3 * i, 35.0 + 22 * (i / 4), true});
  return out;
}

engine::Prior<TrackKltResult> prior_of(const TrackKltResult& result) {
  return engine::Prior<TrackKltResult>(std::make_shared<const TrackKltResult>(result));
}

TrackKltResult first(const std::shared_ptr<const Image>& image, const Landmarks* correction = nullptr) {
  return track_klt({{image}, 0}, points(), correction, {});
}

TrackKltResult next(const std::shared_ptr<const Image>& before, const std::shared_ptr<const Image>& image,
                    const TrackKltResult& prior, const Landmarks* correction = nullptr,
                    const TrackKltOptions& options = {}) {
  return track_klt({{before, image}, 1}, points(), correction, prior_of(prior), options);
}

// RMS distance from the start points moved as picture() moves them.
double rms_px(const Landmarks& found, double dx, double dy, double angle = 0) {
  double sum = 0;
  const Landmarks start = points();
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    const double u = start.points[i].x_px - 80, v = start.points[i].y_px - 60;
    const double x = 80 + dx + std::cos(angle) * u - std::sin(angle) * v,
                 y = 60 + dy + std::sin(angle) * u + std::cos(angle) * v;
    sum += std::pow(found.points[i].x_px - x, 2) + std::pow(found.points[i].y_px - y, 2);
  }
  return std::sqrt(sum / static_cast<double>(found.points.size()));
}

}  // namespace

TEST(TrackKlt, GivesTheStartPointsOnTheFirstFrame) {
  const TrackKltResult result = first(picture(0, 0));
  ASSERT_EQ(result.landmarks.points.size(), 12u);
  EXPECT_EQ(rms_px(result.landmarks, 0, 0), 0);
  EXPECT_EQ(result.landmarks.points[3].name, "p3");
  EXPECT_EQ(result.lost, 0);
  EXPECT_EQ(result.patches.width, 12 * 15);
  EXPECT_EQ(result.patches.height, 2 * 15);  // of the start, and of corrections
}

TEST(TrackKlt, FollowsAKnownTranslationToATenthOfAPixel) {
  const auto before = picture(0, 0);
  const TrackKltResult start = first(before);
  for (const auto& [dx, dy] : {std::pair{0.5, 0.25}, std::pair{3.3, -2.7}, std::pair{-7.9, 5.1}}) {
    const TrackKltResult result = next(before, picture(dx, dy), start);
    EXPECT_EQ(result.lost, 0);
    EXPECT_LE(rms_px(result.landmarks, dx, dy), 0.05) << dx << ", " << dy;  // the bar is 0.1
  }
}

TEST(TrackKlt, FollowsARotationToAFifthOfAPixel) {
  const auto before = picture(0, 0);
  const TrackKltResult result = next(before, picture(0.7, -0.4, 0.05), first(before));
  EXPECT_EQ(result.lost, 0);
  EXPECT_LE(rms_px(result.landmarks, 0.7, -0.4, 0.05), 0.2);
}

TEST(TrackKlt, DoesNotDriftOverSixtyFrames) {
  auto before = picture(0, 0);
  TrackKltResult result = first(before);
  for (int i = 1; i <= 60; ++i) {
    const auto image = picture(6 * std::sin(0.2 * i), 4 * std::sin(0.13 * i));
    result = next(before, image, result);
    before = image;
  }
  EXPECT_EQ(result.lost, 0);
  EXPECT_LE(rms_px(result.landmarks, 6 * std::sin(12.0), 4 * std::sin(7.8)), 0.05);
}

TEST(TrackKlt, HoldsStillWhenNothingMoves) {
  const auto image = picture(0, 0);
  EXPECT_LE(rms_px(next(image, image, first(image)).landmarks, 0, 0), 0.02);
}

TEST(TrackKlt, StaysWithinAQuarterOfAPixelWhenTheLightDims) {
  const auto before = picture(0, 0);
  EXPECT_LE(rms_px(next(before, picture(1.5, 1, 0, 0.93), first(before)).landmarks, 1.5, 1), 0.25);
}

TEST(TrackKlt, TakesACorrectionAndCarriesItForward) {
  const Landmarks correction{{{"p5", 70.25, 61.5, true}}};
  const auto before = picture(0, 0), image = picture(2, 1), after = picture(3.5, 2);
  const TrackKltResult corrected = next(before, image, first(before), &correction);
  EXPECT_EQ(corrected.landmarks.points[5].x_px, 70.25);
  EXPECT_EQ(corrected.landmarks.points[5].y_px, 61.5);
  const TrackKltResult result = next(image, after, corrected);
  EXPECT_NEAR(result.landmarks.points[5].x_px, 71.75, 0.1);
  EXPECT_NEAR(result.landmarks.points[5].y_px, 62.5, 0.1);
}

TEST(TrackKlt, TakesACorrectionOfTheFirstFrame) {
  const Landmarks correction{{{"p0", 44, 37, true}}};
  const TrackKltResult result = first(picture(0, 0), &correction);
  EXPECT_EQ(result.landmarks.points[0].x_px, 44);
  EXPECT_EQ(result.landmarks.points[1].x_px, points().points[1].x_px);
}

TEST(TrackKlt, LosesACoveredPointTakesItAlongAndFindsItAgain) {
  const auto before = picture(0, 0);
  Image covered = *picture(1, 0);
  for (int y = 40; y < 76; ++y)
    for (int x = 50; x < 86; ++x)  // over p5, at (66.5, 57)
      for (int c = 0; c < 3; ++c)
        covered.pixels[static_cast<std::size_t>((y * 160 + x) * 3 + c)] =
            static_cast<std::uint8_t>((x * 31 + y * 17 + x * y) % 256);
  const auto image = std::make_shared<const Image>(covered);
  const TrackKltResult start = first(before), hidden = next(before, image, start);
  EXPECT_FALSE(hidden.landmarks.points[5].valid);
  EXPECT_NEAR(hidden.landmarks.points[5].x_px, points().points[5].x_px + 1, 0.3);
  EXPECT_GE(hidden.lost, 1);
  const TrackKltResult seen = next(image, picture(2, 0), hidden);
  EXPECT_EQ(seen.lost, 0);
  EXPECT_LE(rms_px(seen.landmarks, 2, 0), 0.1);
}

TEST(TrackKlt, LosesAPointThatLeavesTheImage) {
  const auto before = picture(0, 0);
  TrackKltResult result = first(before);
  auto last = before;
  for (int i = 1; i <= 8; ++i) {
    const auto image = picture(-6.0 * i, 0);
    result = next(last, image, result);
    last = image;
  }
  EXPECT_FALSE(result.landmarks.points[0].valid);  // started 40 px from the left edge
  EXPECT_TRUE(result.landmarks.points[3].valid);
}

TEST(TrackKlt, SaysThatNothingIsSeenInAnEvenPicture) {
  const auto grey = std::make_shared<const Image>(Image{160, 120, 3, std::vector<std::uint8_t>(160 * 120 * 3, 90)});
  const TrackKltResult result = next(grey, grey, first(grey));
  EXPECT_EQ(result.lost, 12);
  EXPECT_EQ(rms_px(result.landmarks, 0, 0), 0);
}

TEST(TrackKlt, WorksOnGreyImages) {
  const auto grey = [](double dx) {
    const auto rgb = picture(dx, 0);
    Image image{160, 120, 1, {}};
    for (std::size_t i = 0; i < rgb->pixels.size(); i += 3) image.pixels.push_back(rgb->pixels[i]);
    return std::make_shared<const Image>(image);
  };
  const auto before = grey(0);
  EXPECT_LE(rms_px(next(before, grey(2.5), first(before)).landmarks, 2.5, 0), 0.05);
}

TEST(TrackKlt, GivesTheSameResultTwice) {
  const auto before = picture(0, 0), image = picture(2.2, 1.1);
  const TrackKltResult start = first(before), a = next(before, image, start), b = next(before, image, start);
  for (std::size_t i = 0; i < a.landmarks.points.size(); ++i) {
    EXPECT_EQ(a.landmarks.points[i].x_px, b.landmarks.points[i].x_px);
    EXPECT_EQ(a.landmarks.points[i].y_px, b.landmarks.points[i].y_px);
  }
}

TEST(TrackKlt, ACorrectionChangesNoOtherPointAndNothingFromThePointsNextOneOn) {
  const Landmarks early{{{"p5", 70.25, 61.5, true}}}, later{{{"p5", 72, 63, true}}};
  const std::vector<std::shared_ptr<const Image>> film = {picture(0, 0), picture(2, 1), picture(3.5, 2),
                                                          picture(5, 2.5)};
  const auto track = [&](const Landmarks* at_1) {
    std::vector<TrackKltResult> out = {first(film[0])};
    for (std::size_t i = 1; i < film.size(); ++i)
      out.push_back(next(film[i - 1], film[i], out.back(), i == 1 ? at_1 : i == 3 ? &later : nullptr));
    return out;
  };
  const auto with = track(&early), without = track(nullptr);
  for (std::size_t i = 0; i < film.size(); ++i)
    for (std::size_t k = 0; k < 12; ++k) {
      const Landmark &a = with[i].landmarks.points[k], &b = without[i].landmarks.points[k];
      const bool same = a.x_px == b.x_px && a.y_px == b.y_px && a.valid == b.valid;
      EXPECT_EQ(same, k != 5 || i == 0 || i == 3) << "point " << k << " of frame " << i;
    }
  // All of the result, so that the engine stops there.
  EXPECT_EQ(with[3].patches.pixels, without[3].patches.pixels);
  EXPECT_EQ(with[3].layout.points[5].x_px, without[3].layout.points[5].x_px);
  EXPECT_EQ(with[3].confidence.values, without[3].confidence.values);
}

// Points are placed on the first frame that shows something; what was learnt from the black one before was never found.
TEST(TrackKlt, BeginsWhereABlackFilmBegins) {
  const auto black = std::make_shared<const Image>(Image{160, 120, 3, std::vector<std::uint8_t>(160 * 120 * 3, 3)});
  TrackKltResult result = first(black);
  EXPECT_EQ(result.state, "even");
  EXPECT_FALSE(result.valid);
  EXPECT_EQ(result.lost, 12);
  result = next(black, black, result);
  EXPECT_EQ(result.state, "even");
  const auto before = picture(0, 0), after = picture(2, 1);
  result = next(black, before, result);
  EXPECT_EQ(result.state, "start");
  EXPECT_EQ(result.lost, 0);
  result = next(before, after, result);
  EXPECT_EQ(result.state, "followed");
  for (std::size_t i = 0; i < result.landmarks.points.size(); ++i)
    EXPECT_NEAR(result.landmarks.points[i].x_px, points().points[i].x_px + 2, 0.1) << i;
}

TEST(TrackKlt, BeginsAgainWhileTheFilmIsFadedIn) {
  const auto lit = [](double share) {
    Image image = *picture(0, 0);
    for (std::uint8_t& value : image.pixels) value = static_cast<std::uint8_t>(share * value);
    return std::make_shared<const Image>(std::move(image));
  };
  const auto dark = lit(0.2), dim = lit(0.6), full = lit(1);
  TrackKltResult result = first(dark);
  result = next(dark, dim, result);
  EXPECT_EQ(result.state, "start");
  result = next(dim, full, result);
  EXPECT_EQ(result.state, "start");
  EXPECT_EQ(result.patches.pixels, first(full).patches.pixels);
  EXPECT_EQ(next(full, full, result).state, "followed");
}

TEST(TrackKlt, NamesABlackFrameAndFindsThePointsAfterIt) {
  const auto before = picture(0, 0), after = picture(9, -6);
  const auto black = std::make_shared<const Image>(Image{160, 120, 3, std::vector<std::uint8_t>(160 * 120 * 3, 3)});
  const TrackKltResult dark = next(before, black, first(before));
  EXPECT_EQ(dark.state, "even");
  EXPECT_FALSE(dark.valid);
  EXPECT_EQ(dark.lost, 12);
  EXPECT_EQ(dark.landmarks.points[3].x_px, points().points[3].x_px);
  const TrackKltResult again = next(black, after, dark);
  EXPECT_EQ(again.state, "found");
  EXPECT_TRUE(again.valid);
  EXPECT_LE(rms_px(again.landmarks, 9, -6), 0.1);
}

TEST(TrackKlt, SaysThatTheFaceHasLeftThePictureAndFindsItWhenItIsBack) {
  auto last = picture(0, 0);
  TrackKltResult result = first(last);
  int valid = 0;
  for (int i = 1; i <= 22; ++i) {
    const auto image = picture(-6.0 * i, 0);
    result = next(last, image, result);
    last = image;
    valid += result.valid ? 1 : 0;
  }
  EXPECT_GE(valid, 8);  // while a third of the points is in it
  EXPECT_FALSE(result.valid);
  EXPECT_EQ(result.state, "lost");
  EXPECT_EQ(result.lost, 12);
  for (const Landmark& point : result.landmarks.points) EXPECT_GE(point.x_px, -0.5) << point.name;  // last good places
  const TrackKltResult back = next(last, picture(3, 2), result);
  EXPECT_EQ(back.state, "found");
  EXPECT_TRUE(back.valid);
  EXPECT_LE(rms_px(back.landmarks, 3, 2), 0.1);
}

TEST(TrackKlt, NamesACutAndSeesNothingInAnotherPicture) {
  const auto before = picture(0, 0);
  Random random(5);
  Image noise{160, 120, 3, {}};
  for (int i = 0; i < 160 * 120 * 3; ++i) noise.pixels.push_back(static_cast<std::uint8_t>(random.uniform(0, 255)));
  const auto other = std::make_shared<const Image>(noise);
  const TrackKltResult cut = next(before, other, first(before));
  EXPECT_EQ(cut.state, "cut");
  EXPECT_FALSE(cut.valid);
  EXPECT_EQ(cut.lost, 12);
  const TrackKltResult still = next(other, other, cut);
  EXPECT_EQ(still.state, "lost");
  EXPECT_EQ(next(other, before, still).state, "found");
}

TEST(TrackKlt, FollowsTheFaceToItsNewPlaceOverACut) {
  const auto before = picture(0, 0), after = picture(22, -13);  // the same, elsewhere: hardly alike pixel by pixel
  const TrackKltResult cut = next(before, after, first(before));
  EXPECT_EQ(cut.state, "cut");
  EXPECT_TRUE(cut.valid);
  // Two points left the picture.
  for (std::size_t i = 0; i < 12; ++i)
    if (cut.landmarks.points[i].valid) {
      EXPECT_NEAR(cut.landmarks.points[i].x_px, points().points[i].x_px + 22, 0.2) << i;
      EXPECT_NEAR(cut.landmarks.points[i].y_px, points().points[i].y_px - 13, 0.2) << i;
    }
}

TEST(TrackKlt, IsSureOfWhatLooksAsAtTheStartOnly) {
  const auto before = picture(0, 0);
  const TrackKltResult result = next(before, picture(1, 1), first(before));
  ASSERT_EQ(result.confidence.rows, 12u);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_GT(result.confidence.at(i, 0), 0.98);
  const auto turned = next(before, picture(1, 1, 0.12), first(before));
  EXPECT_LT(turned.confidence.at(0, 0), result.confidence.at(0, 0));
}

TEST(TrackKlt, RejectsAnOutlineWithAPointMissing) {
  Landmarks start = points();
  for (int i = 0; i < 11; ++i) start.points[static_cast<std::size_t>(i)].name = "lip_" + std::to_string(i);
  EXPECT_THROW_TEXT(track_klt({{picture(0, 0)}, 0}, start, nullptr, {}),
                    "start has 11 of the outline's 12 points, expected all or none: lip_11 is missing");
}

TEST(TrackKlt, AcceptsNoPoints) {
  const auto image = picture(0, 0);
  const TrackKltResult start = track_klt({{image}, 0}, {}, nullptr, {});
  const TrackKltResult result = track_klt({{image, image}, 1}, {}, nullptr, prior_of(start));
  EXPECT_TRUE(result.landmarks.points.empty());
}

TEST(TrackKlt, RejectsAStartPointOutsideTheImage) {
  Landmarks start = points();
  start.points[2].x_px = 400;
  EXPECT_THROW_TEXT(track_klt({{picture(0, 0)}, 0}, start, nullptr, {}),
                    "start point p2 is at (400, 35), outside the frame of 160 x 120 pixels");
}

TEST(TrackKlt, RejectsACorrectionOfAnUnknownPoint) {
  const Landmarks correction{{{"lip_99", 70, 61, true}}};
  EXPECT_THROW_TEXT(
      first(picture(0, 0), &correction),
      "a correction names the point lip_99, which start does not have; it has p0, p1, p2, p3, p4, p5, p6, p7, "
      "p8, p9, p10, p11");
}

TEST(TrackKlt, RejectsACorrectionOutsideTheImage) {
  const Landmarks correction{{{"p1", -7, 61, true}}};
  EXPECT_THROW_TEXT(first(picture(0, 0), &correction),
                    "the correction of p1 is at (-7, 61), outside the frame of 160 x 120 pixels");
}

TEST(TrackKlt, RejectsFramesOfUnequalSize) {
  const auto before = picture(0, 0);
  const auto small = std::make_shared<const Image>(Image{140, 120, 3, std::vector<std::uint8_t>(140 * 120 * 3)});
  EXPECT_THROW_TEXT(next(before, small, first(before)), "the frame is 140 x 120 pixels, the previous one 160 x 120");
}

TEST(TrackKlt, RejectsAnEvenWindow) {
  TrackKltOptions options;
  options.window_px = 14;
  EXPECT_THROW_TEXT(track_klt({{picture(0, 0)}, 0}, points(), nullptr, {}, options),
                    "window_px is 14, expected an odd number");
}
