// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/head_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "nodes/base/find_landmark.h"
#include "nodes/base/random.h"
#include "nodes/track/track_klt.h"
#include "tests/nodes/track/phantom_clip.h"

using namespace face;
using namespace face::track;

namespace {

// A made person, seen from where the camera stands.
struct View {
  Image image;
  Landmarks truth;  // the 18 points
};

class PersonInView {
 public:
  PersonInView() {
    phantom::MakePersonOptions options;
    options.spread = 0;
    person_ = phantom::make_person(phantom::make_head(), nullptr, nullptr, options);
  }

  View seen_from(double yaw_deg, double pitch_deg, const Weights& weights = {}) const {
    phantom::MakeCameraOptions place;
    place.yaw_deg = yaw_deg, place.pitch_deg = pitch_deg;
    const Camera camera = phantom::make_camera(place);
    const Image backdrop = phantom::make_backdrop();
    const std::string id = "0";
    phantom::TruthLandmarksOptions set;
    set.set = phantom::LandmarkSet::lips18;
    return {phantom::video_frame(person_.person, weights, nullptr, camera, phantom::make_lighting(), &person_.dots,
                                 &backdrop, &id),
            phantom::truth_landmarks(person_.person, weights, nullptr, camera, set)};
  }

 private:
  decltype(phantom::make_person(phantom::make_head(), nullptr, nullptr, {})) person_;
};

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

// How far the head of that pose has the corners of the eyes from where they are, px.
double eyes_off_px(const HeadPose& pose, const Landmarks& start, const Landmarks& truth) {
  double most = 0;
  for (const char* name : {"eye_inner_r", "eye_inner_l"}) {
    const Landmark &from = *find_landmark(start, name), &to = *find_landmark(truth, name);
    const auto place = head_at(pose, start).seen({from.x_px, from.y_px}, 0);
    most = std::max(most, std::hypot(place.real() - to.x_px, place.imag() - to.y_px));
  }
  return most;
}

}  // namespace

TEST(HeadMotion, TellsATurnFromAStepAside) {
  const PersonInView person;
  const View front = person.seen_from(0, 0);
  const Image learnt = learn_head(grey_of(front.image), front.truth);
  HeadPose pose = start_pose(front.truth);
  for (const double yaw_deg : {6.0, 12.0, 18.0}) {
    const View view = person.seen_from(yaw_deg, 0);
    const HeadSight sight = find_head(grey_of(view.image), front.truth, learnt, pose);
    pose = sight.pose;
    EXPECT_GT(sight.likeness, 0.7) << yaw_deg;
    EXPECT_NEAR(std::abs(degrees(pose.turn)), yaw_deg, 4);
    EXPECT_NEAR(degrees(pose.nod), 0, 3);
    // Her eyes lie deeper than the mean person's.
    EXPECT_LT(eyes_off_px(pose, front.truth, view.truth), 0.5 + 0.25 * yaw_deg) << yaw_deg;
  }
}

TEST(HeadMotion, TellsANodFromAStepBack) {
  const PersonInView person;
  const View front = person.seen_from(0, 0), nod = person.seen_from(0, 12);
  const HeadSight sight = find_head(grey_of(nod.image), front.truth, learn_head(grey_of(front.image), front.truth),
                                    start_pose(front.truth));
  EXPECT_NEAR(std::abs(degrees(sight.pose.nod)), 12, 4);
  EXPECT_NEAR(sight.pose.log_scale, 0, 0.03);
  EXPECT_LT(eyes_off_px(sight.pose, front.truth, nod.truth), 3.5);
}

// A film may begin with a head that looks aside: a solid that faces the camera was turned by half as much.
TEST(HeadMotion, TellsATurnOfAHeadThatLookedAsideAtTheStart) {
  const PersonInView person;
  const View aside = person.seen_from(18, 4);
  const Image learnt = learn_head(grey_of(aside.image), aside.truth);
  HeadPose pose = start_pose(aside.truth);
  for (const double yaw_deg : {12.0, 6.0, 0.0, -6.0}) {
    const View view = person.seen_from(yaw_deg, 4);
    pose = find_head(grey_of(view.image), aside.truth, learnt, pose).pose;
    EXPECT_NEAR(std::abs(degrees(pose.turn)), 18 - yaw_deg, 4) << yaw_deg;
    EXPECT_NEAR(degrees(pose.nod), 0, 3) << yaw_deg;
  }
}

TEST(HeadMotion, IsNotMovedByABlink) {
  const PersonInView person;
  Weights shut;
  shut.values = {1, 0, 0, 0, 0, 0, 0, 1};  // eyeBlinkLeft to eyeBlinkRight
  const View front = person.seen_from(0, 0), blink = person.seen_from(0, 0, shut);
  const HeadSight sight = find_head(grey_of(blink.image), front.truth, learn_head(grey_of(front.image), front.truth),
                                    start_pose(front.truth));
  EXPECT_LT(eyes_off_px(sight.pose, front.truth, front.truth), 1);
  EXPECT_LT(std::abs(degrees(sight.pose.nod)), 1.5);
}

TEST(HeadMotion, GoesWithThePictureAndDoesNotMindItsBrightness) {
  const PersonInView person;
  const View front = person.seen_from(0, 0);
  const Grey grey = grey_of(front.image);
  Grey moved = grey;
  for (int y = 0; y < grey.height; ++y)
    for (int x = 0; x < grey.width; ++x)
      moved.values[static_cast<std::size_t>(y * grey.width + x)] = 0.6f * grey.at(x - 14, y + 9) + 30;
  const HeadPose start = start_pose(front.truth);
  const HeadSight sight = find_head(moved, front.truth, learn_head(grey, front.truth), start);
  EXPECT_NEAR(sight.pose.x_px - start.x_px, 14, 0.3);
  EXPECT_NEAR(sight.pose.y_px - start.y_px, -9, 0.3);
  EXPECT_GT(sight.likeness, 0.95);
}

TEST(HeadMotion, IsNotSeenInNoise) {
  const PersonInView person;
  const View front = person.seen_from(0, 0);
  Grey noise = grey_of(front.image);
  Random random(1, 1);
  for (float& value : noise.values) value = static_cast<float>(255 * random.uniform());
  const HeadSight sight =
      find_head(noise, front.truth, learn_head(grey_of(front.image), front.truth), start_pose(front.truth));
  EXPECT_LT(sight.likeness, 0.3);
}

TEST(HeadMotion, NeedsTheCornersOfTheEyesAndTheTipOfTheNose) {
  const Grey grey{64, 64, std::vector<float>(64 * 64, 100)};
  const Landmarks lips{{{"lip_0", 20, 40, true}, {"lip_6", 40, 40, true}}};
  EXPECT_TRUE(learn_head(grey, lips).pixels.empty());
  EXPECT_EQ(find_head(grey, lips, learn_head(grey, lips), start_pose(lips)).likeness, 0);
}

TEST(HeadMotion, KeepsPointsOfATurnedHeadThatLooksOtherwise) {
  // The patches of the corners of the eyes and of the nose do not look as from in front: the points were lost.
  const PersonInView person;
  std::vector<View> views;
  for (const double yaw_deg : {0.0, 5.0, 10.0, 15.0, 20.0}) views.push_back(person.seen_from(yaw_deg, 0));
  TrackKltResult tracked;
  for (std::size_t i = 0; i < views.size(); ++i) {
    std::vector<std::shared_ptr<const Image>> pair;
    if (i > 0) pair.push_back(std::make_shared<const Image>(views[i - 1].image));
    pair.push_back(std::make_shared<const Image>(views[i].image));
    engine::Prior<TrackKltResult> prior;
    if (i > 0) prior = engine::Prior<TrackKltResult>(std::make_shared<const TrackKltResult>(tracked));
    tracked = track_klt(engine::Window<Image>(pair, i > 0 ? 1 : 0), views[0].truth, nullptr, prior, {});
  }
  for (const char* name : {"eye_inner_r", "eye_inner_l", "nose_tip", "lip_0", "lip_6"}) {
    const Landmark &point = *find_landmark(tracked.landmarks, name), &truth = *find_landmark(views.back().truth, name);
    EXPECT_TRUE(point.valid) << name;
    EXPECT_LT(std::hypot(point.x_px - truth.x_px, point.y_px - truth.y_px), 5) << name;
  }
}

TEST(HeadMotion, OfAFrameThatDoesNotShowTheHeadIsNotKnown) {
  const PersonInView person;
  const View front = person.seen_from(0, 0);
  const auto shown = std::make_shared<const Image>(front.image);
  Image black = front.image;
  std::fill(black.pixels.begin(), black.pixels.end(), std::uint8_t{0});
  const auto hidden = std::make_shared<const Image>(black);
  TrackKltResult tracked = track_klt(engine::Window<Image>({shown}, 0), front.truth, nullptr, {}, {});
  EXPECT_EQ(tracked.head.at(6, 0), 1);
  for (const auto& [before, now] : {std::pair{shown, shown}, {shown, hidden}, {hidden, shown}}) {
    const engine::Prior<TrackKltResult> prior(std::make_shared<const TrackKltResult>(tracked));
    tracked = track_klt(engine::Window<Image>({before, now}, 1), front.truth, nullptr, prior, {});
    if (now == hidden)
      EXPECT_EQ(tracked.head.at(6, 0), 0);
    else
      EXPECT_GT(tracked.head.at(6, 0), 0.9);
  }
}
