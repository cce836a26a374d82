// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/light_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/track/head_motion.h"
#include "tests/nodes/track/grid_clip.h"
#include "tests/nodes/track/phantom_clip.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::track;

const Image& picture() { return *test::resting_speaker().frames[0]; }
const Landmarks& points() { return test::resting_speaker().truth[0]; }

template <class Function>
Image changed(Image image, const Function& value_of) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint8_t>(std::clamp(value_of(image.pixels[i], i % 3) + 0.5, 0.0, 255.0));
  return image;
}

LightChange light_in(const Image& image) {
  return see_light_change(image, points(), head_at(start_pose(points()), points()), learn_light(picture(), points()));
}

}  // namespace

TEST(LightChange, TellsGainAndOffsetOfEveryColour) {
  const std::array<double, 3> gain{0.6, 0.7, 0.8}, offset{20, -5, 30};
  const LightChange light =
      light_in(changed(picture(), [&](double v, std::size_t c) { return gain[c] * v + offset[c]; }));
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(light.gain[c], 1 / gain[c], 0.03) << c;  // whole grey values
    EXPECT_NEAR(light.gain[c] * (gain[c] * 128 + offset[c]) + light.offset[c], 128, 2) << c;
  }
}

TEST(LightChange, IsTheSameWhereALittleHasChanged) {
  EXPECT_TRUE(light_in(picture()).is_same());
  EXPECT_TRUE(light_in(changed(picture(), [](double v, std::size_t) { return v + 5; })).is_same());
  EXPECT_FALSE(light_in(changed(picture(), [](double v, std::size_t) { return v + 20; })).is_same());
}

// A lamp that clips red in most of the face, as film of real people has it.
TEST(LightChange, GoesByTheOtherColoursWhereOneIsClipped) {
  const double lamp = 255 - 0.9 * (*std::max_element(picture().pixels.begin(), picture().pixels.end()));
  const Image bright = changed(picture(), [&](double v, std::size_t c) { return v + (c == 0 ? lamp + 60 : 40); });
  const LightChange light = light_in(bright);
  EXPECT_NEAR(light.gain[0], 1, 0.1);
  EXPECT_NEAR(light.offset[1], -40, 3);
}

TEST(LightChange, RelitPicturesLookAsAtTheStart) {
  const Image dim = changed(picture(), [](double v, std::size_t) { return 0.5 * v + 30; });
  const Image lit = relit(dim, light_of(light_numbers(light_in(dim))));
  double square = 0;
  for (std::size_t i = 0; i < lit.pixels.size(); ++i)
    square += std::pow(double(lit.pixels[i]) - picture().pixels[i], 2) / double(lit.pixels.size());
  EXPECT_LT(std::sqrt(square), 3);
  EXPECT_EQ(relit(picture(), {}).pixels, picture().pixels);
}

TEST(LightChange, RejectsWhatIsNoLight) {
  EXPECT_TRUE(light_of({}).is_same());
  EXPECT_THROW_TEXT(light_of({2, 2, {1, 0, 1, 0}}), "light is 2 x 2, expected 3 x 2 as track.klt gives it");
}

// A lamp that was turned on left lips at half their height.
TEST(LightChange, LipsAreFollowedWhereALampIsTurnedOn) {
  const test::PhantomClip clip = test::film_phantom("Bob.", 16, test::Dots::none);
  constexpr std::size_t on_from = 6;
  auto frames = clip.frames;
  for (std::size_t t = on_from; t < frames.size(); ++t)
    frames[t] = std::make_shared<const Image>(changed(*frames[t], [](double v, std::size_t) { return 0.8 * v + 75; }));
  const auto lips_off_px = [&](const std::vector<TrackKltResult>& tracked) {
    double square = 0, count = 0;
    for (std::size_t t = on_from; t < tracked.size(); ++t)
      for (std::size_t i = 0; i < clip.truth[t].points.size(); ++i) {
        const Landmark &found = tracked[t].landmarks.points[i], &truth = clip.truth[t].points[i];
        if (!found.name.starts_with("lip_")) continue;
        square += std::pow(found.x_px - truth.x_px, 2) + std::pow(found.y_px - truth.y_px, 2);
        ++count;
      }
    return std::sqrt(square / count);
  };
  const auto tracked = test::track_frames(frames, points()), plain = test::track_frames(clip.frames, points());
  std::printf("%.2f px, without the lamp %.2f px\n", lips_off_px(tracked), lips_off_px(plain));
  EXPECT_LT(lips_off_px(tracked), lips_off_px(plain) + 0.3);
  EXPECT_TRUE(light_of(tracked[on_from - 1].light).is_same());
  EXPECT_FALSE(light_of(tracked[on_from].light).is_same());
}
