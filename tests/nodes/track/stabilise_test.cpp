// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/stabilise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::track;

Landmarks rest() {
  return {{{"eye_inner_r", 140, 100}, {"eye_inner_l", 180, 101}, {"nose_tip", 160, 140}, {"lip_0", 140, 170}}};
}

Landmarks turned(Landmarks points, double angle, double scale, double dx, double dy) {
  for (Landmark& point : points.points) {
    const double x = point.x_px, y = point.y_px;
    point.x_px = scale * (std::cos(angle) * x - std::sin(angle) * y) + dx;
    point.y_px = scale * (std::sin(angle) * x + std::cos(angle) * y) + dy;
  }
  return points;
}

engine::Window<Landmarks> window(const std::vector<Landmarks>& frames, std::size_t centre) {
  std::vector<std::shared_ptr<const Landmarks>> held;
  for (const Landmarks& frame : frames) held.push_back(std::make_shared<const Landmarks>(frame));
  return {held, centre};
}

}  // namespace

TEST(Stabilise, TakesAMovedTurnedScaledHeadBack) {
  Landmarks open = rest();
  open.points[3].y_px = 177;
  const Landmarks moved = turned(open, 0.2, 1.1, 14, -9);
  const Landmarks stable = stabilise(window({moved, moved}, 1), rest(), nullptr, nullptr);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(stable.points[i].x_px, open.points[i].x_px, 1e-9);
    EXPECT_NEAR(stable.points[i].y_px, open.points[i].y_px, 1e-9);
  }
}

TEST(Stabilise, TremblesLessWithNeighbours) {
  Landmarks shaken = rest();
  shaken.points[0].y_px += 1;
  const StabiliseOptions alone{.smooth_frames = 0};
  const auto off = [&](const StabiliseOptions& options) {
    const Landmark lip = stabilise(window({rest(), shaken, rest()}, 1), rest(), nullptr, nullptr, options).points[3];
    return std::hypot(lip.x_px - 140, lip.y_px - 170);
  };
  const double plain = off(alone), smooth = off({});
  EXPECT_GT(plain, 0.3);
  EXPECT_LT(smooth, 0.6 * plain);
}

// A camera in somebody's hand moved the mouth over the head by as much as it shook.
TEST(Stabilise, LeavesTheMouthInItsPlaceWhereTheCameraShakes) {
  const std::vector<Landmarks> frames = {turned(rest(), 0.02, 1, -6, 4), turned(rest(), -0.03, 1, 7, -5),
                                         turned(rest(), 0.03, 1, -5, 6), turned(rest(), -0.02, 1, 6, -7),
                                         turned(rest(), 0.03, 1, -7, 5)};
  for (std::size_t at = 0; at < frames.size(); ++at) {
    const Landmark lip = stabilise(window(frames, at), rest(), nullptr, nullptr).points[3];
    EXPECT_NEAR(lip.x_px, 140, 0.3) << "frame " << at;  // 6 px before
    EXPECT_NEAR(lip.y_px, 170, 0.3) << "frame " << at;
  }
}

TEST(Stabilise, KeepsTheScaleWhereOnePointIsSeen) {
  Landmarks moved = turned(rest(), 0, 1, 5, 6);
  moved.points[0].valid = moved.points[1].valid = false;
  const Landmarks stable = stabilise(window({moved}, 0), rest(), nullptr, nullptr);
  EXPECT_NEAR(stable.points[3].x_px, 140, 1e-9);
  EXPECT_NEAR(stable.points[3].y_px, 170, 1e-9);
  EXPECT_TRUE(stable.points[3].valid);
}

TEST(Stabilise, SaysThatNothingIsKnownWithoutARigidPoint) {
  Landmarks lost = rest();
  for (std::size_t i = 0; i < 3; ++i) lost.points[i].valid = false;
  const Landmarks stable = stabilise(window({rest(), lost}, 1), rest(), nullptr, nullptr);
  for (const Landmark& point : stable.points) EXPECT_FALSE(point.valid);
  EXPECT_EQ(stable.points[3].y_px, 170);
}

TEST(Stabilise, NamesARigidPointThatRestDoesNotHave) {
  EXPECT_THROW_TEXT(stabilise(window({rest()}, 0), {{{"lip_0", 1, 2}}}, nullptr, nullptr),
                    "rest has no point eye_inner_r, expected all rigid ones");
}

namespace {

// What a camera far away sees of a solid head that nods (its chin down) and turns, at these depths.
Landmarks nodded(Landmarks points, const Matrix& depths_px, double nod, double turn) {
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    const double x = points.points[i].x_px - 160, y = points.points[i].y_px - 110, z = depths_px.at(i, 0);
    const double y1 = std::cos(nod) * y - std::sin(nod) * z, z1 = std::sin(nod) * y + std::cos(nod) * z;
    points.points[i].x_px = 165 + std::cos(turn) * x + std::sin(turn) * z1;
    points.points[i].y_px = 112 + y1;
  }
  return points;
}

}  // namespace

TEST(Stabilise, TakesANodAndATurnOutWhereDepthsAreKnown) {
  const Matrix depths{4, 1, {0, 0, 40, 25}};
  Landmarks open = rest();
  open.points[3].y_px += 7;
  const Landmarks seen = nodded(open, depths, 0.1, -0.07);
  const auto off = [&](const Matrix* known) {
    const Landmark lip = stabilise(window({seen}, 0), rest(), known, nullptr).points[3];
    return std::hypot(lip.x_px - open.points[3].x_px, lip.y_px - open.points[3].y_px);
  };
  EXPECT_GT(off(nullptr), 3);
  EXPECT_LT(off(&depths), 0.25);  // likelier angles are smaller ones
}

namespace {

// As track.klt gives it.
Matrix pose(double nod, double turn, double likeness) { return {7, 1, {nod, turn, 0, 0, 165, 112, likeness}}; }

}  // namespace

// Three points turned a head of 20 degrees by 15, and the mouth went sideways by what was missing.
TEST(Stabilise, TakesALargeTurnOutWhereTheWholeHeadTellsIt) {
  const Matrix depths{4, 1, {0, 0, 40, 25}};
  Landmarks open = rest();
  open.points[3].y_px += 7;
  Landmarks seen = nodded(open, depths, -0.15, 0.35);
  seen.points[2].x_px += 1;  // the tip of the nose is seen a little beside its place
  const Matrix head = pose(-0.15, 0.35, 0.9), lost = pose(-0.15, 0.35, 0);
  const auto off = [&](const Matrix* known) {
    const Landmark lip = stabilise(window({seen}, 0), rest(), &depths, known).points[3];
    return std::hypot(lip.x_px - open.points[3].x_px, lip.y_px - open.points[3].y_px);
  };
  EXPECT_GT(off(nullptr), 1.2);
  EXPECT_LT(off(&head), 0.8 * off(nullptr)) << "the nose alone puts it 0.3 px aside";
  EXPECT_EQ(off(&lost), off(nullptr)) << "a head that is not seen tells nothing";
}

// Corners of eyes that look otherwise in a head that is turned are beside their places as long as it is turned: frames
// that are all wrong alike outvoted the head.
TEST(Stabilise, FramesWhosePointsAreOffAlikeCountAsOneBesideTheHead) {
  const Matrix depths{4, 1, {0, 0, 40, 25}}, head = pose(-0.15, 0.35, 0.9);
  Landmarks seen = nodded(rest(), depths, -0.15, 0.35);
  seen.points[2].y_px += 3;
  const auto off = [&](const engine::Window<Landmarks>& frames) {
    const Landmark lip = stabilise(frames, rest(), &depths, &head).points[3];
    return std::hypot(lip.x_px - rest().points[3].x_px, lip.y_px - rest().points[3].y_px);
  };
  EXPECT_GT(off(window({seen}, 0)), 0.1);
  EXPECT_NEAR(off(window({seen, seen, seen, seen, seen, seen, seen}, 3)), off(window({seen}, 0)), 0.01);
}

TEST(Stabilise, OnePointPlacesAHeadWhosePoseIsKnown) {
  const Matrix depths{4, 1, {0, 0, 40, 25}}, head = pose(0.1, -0.07, 0.9);
  Landmarks seen = nodded(rest(), depths, 0.1, -0.07);
  seen.points[0].valid = seen.points[1].valid = false;
  const Landmark lip = stabilise(window({seen}, 0), rest(), &depths, &head).points[3];
  EXPECT_NEAR(lip.x_px, 140, 0.5);
  EXPECT_NEAR(lip.y_px, 170, 0.5);
}

TEST(Stabilise, RejectsAPoseThatIsNone) {
  const Matrix depths{4, 1, {0, 0, 40, 25}}, three{3, 1, {0, 0, 0}};
  EXPECT_THROW_TEXT(stabilise(window({rest()}, 0), rest(), &depths, &three),
                    "head is 3 x 1, expected 7 x 1 as track.klt gives it");
  const Matrix wild = pose(std::nan(""), 0, 1);
  EXPECT_THROW_TEXT(stabilise(window({rest()}, 0), rest(), &depths, &wild), "head has nan, expected finite numbers");
}

TEST(Stabilise, LeavesAHeadThatDidNotMoveWhereItIsWhateverTheDepths) {
  const Matrix depths{4, 1, {0, 0, 40, 25}};
  Landmarks open = rest();
  open.points[3].y_px += 7;
  const Landmark lip = stabilise(window({open}, 0), rest(), &depths, nullptr).points[3];
  EXPECT_NEAR(lip.x_px, 140, 1e-6);
  EXPECT_NEAR(lip.y_px, 177, 1e-6);
}

TEST(Stabilise, RejectsDepthsOfAnotherNumberOfPoints) {
  const Matrix depths{3, 1, {0, 0, 40}};
  EXPECT_THROW_TEXT(stabilise(window({rest()}, 0), rest(), &depths, nullptr),
                    "depths_px is 3 x 1, expected 4 x 1 as rest has points");
  const Matrix empty{4, 1, {}};
  EXPECT_THROW_TEXT(stabilise(window({rest()}, 0), rest(), &empty, nullptr),
                    "depths_px is 4 x 1 with another number of values, expected 4 x 1 as rest has points");
}

namespace {

// A head that turns steadily while the corners of its eyes are lost in frames 3 to 6; in frames 4 and 5 lids have
// carried one of them along.
std::vector<Landmarks> blinking(const Matrix& depths_px) {
  std::vector<Landmarks> frames;
  for (int i = 0; i < 10; ++i) {
    Landmarks seen = nodded(rest(), depths_px, 0.1 - 0.01 * i, 0.02 * i);
    for (std::size_t k = 0; k < 2; ++k) seen.points[k].valid = i < 3 || i > 6 || (k == 1 && (i == 4 || i == 5));
    if (i == 4 || i == 5) seen.points[1].y_px += 3;
    frames.push_back(seen);
  }
  return frames;
}

}  // namespace

TEST(Stabilise, BridgesABlinkOfATurnedHead) {
  const Matrix depths{4, 1, {0, 0, 40, 25}};
  const std::vector<Landmarks> frames = blinking(depths);
  for (const std::size_t at : {3u, 4u, 5u, 6u}) {
    const Landmark lip = stabilise(window(frames, at), rest(), &depths, nullptr, {.smooth_frames = 0}).points[3];
    EXPECT_NEAR(lip.x_px, 140, 0.5) << "frame " << at;
    EXPECT_NEAR(lip.y_px, 170, 0.5) << "frame " << at;
  }
  const std::vector<Landmarks> alone = {frames[5]};
  EXPECT_GT(std::abs(stabilise(window(alone, 0), rest(), &depths, nullptr).points[3].y_px - 170), 1);
}

TEST(Stabilise, BridgesABlinkAtTheEndFromOneSide) {
  const Matrix depths{4, 1, {0, 0, 40, 25}};
  std::vector<Landmarks> frames = blinking(depths);
  frames.resize(5);
  const Landmark lip = stabilise(window(frames, 4), rest(), &depths, nullptr, {.smooth_frames = 0}).points[3];
  EXPECT_NEAR(lip.x_px, 140, 1);
  EXPECT_NEAR(lip.y_px, 170, 1);
}

// Of a slow blink, filmed 50 times a second, the middle knew nothing of how the head is turned: lips were 4 mm off.
TEST(Stabilise, BridgesABlinkOfManyFrames) {
  const Matrix depths{4, 1, {0, 0, 40, 25}};
  std::vector<Landmarks> frames;
  for (const Landmarks& frame : blinking(depths)) frames.insert(frames.end(), 8, frame);
  const Landmark lip = stabilise(window(frames, 40), rest(), &depths, nullptr, {.smooth_frames = 0}).points[3];
  EXPECT_NEAR(lip.x_px, 140, 0.5);
  EXPECT_NEAR(lip.y_px, 170, 0.5);
}
