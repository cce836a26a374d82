// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/align/choose_reference.h"
#include "nodes/align/crop.h"
#include "nodes/align/find_markers.h"
#include "nodes/align/fit_axis.h"
#include "nodes/align/measure_dot.h"
#include "nodes/align/orient.h"
#include "nodes/align/track_markers.h"
#include "tests/support/expect_throw_text.h"
#include "tests/support/phantom_stream.h"

namespace {

using namespace face;
using namespace face::align;

const test::PhantomStream& stream() {
  static const test::PhantomStream made;
  return made;
}

RigidMotion motion_of(double yaw, double pitch, double x, double y, double z) {
  RigidMotion m;
  const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
  m.rotation = {cy, sy * sp, sy * cp, 0, cp, -sp, -sy, cy * sp, cy * cp};
  m.translation_mm = {x, y, z};
  return m;
}

// A head that sways and speaks for a moment.
std::vector<test::PhantomStream::Frame> take(int frames) {
  std::vector<test::PhantomStream::Frame> out;
  for (int t = 0; t < frames; ++t) {
    const float open = 0.25f * (1 - std::cos(0.35f * static_cast<float>(t)));
    out.push_back(stream().frame(stream().weights({{"jawOpen", open}, {"mouthSmileLeft", 0.3f * open}}),
                                 motion_of(0.05 * std::sin(0.2 * t), 0.03 * std::sin(0.13 * t), 2 * std::sin(0.17 * t),
                                           1.5 * std::sin(0.11 * t), 0),
                                 std::to_string(t)));
  }
  return out;
}

// The markers that find_markers sees well (not those at the edge of the scan), at their true places.
Landmarks true_start(const test::PhantomStream::Frame& frame) {
  const Landmarks found = find_markers(engine::Seq<DepthScan>({frame.scan}));
  Landmarks out;
  for (const Landmark& p : stream().marker_truth(frame).points)
    for (const Landmark& f : found.points)
      if (p.x_px > 195 && p.x_px < 445 && std::hypot(p.x_px - f.x_px, p.y_px - f.y_px) < 0.3) {
        out.points.push_back(p);
        break;
      }
  return out;
}

engine::Progress quiet;

// What a node warns of.
class Heard : public engine::Progress {
 public:
  void warn(const std::string& text) override { texts.push_back(text); }
  std::vector<std::string> texts;
};

// A scan of 96 x 96 pixels whose grey at a place is light(x, y).
template <class Light>
DepthScan drawn_scan(Light light) {
  DepthScan scan;
  scan.picture = {96, 96, 1, {}};
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x)
      scan.picture.pixels.push_back(static_cast<std::uint8_t>(std::lround(std::clamp<double>(light(x, y), 0, 255))));
  scan.depth_mm.assign(96 * 96, 600.0f);
  return scan;
}

// How much of a place (x, y beside its middle) a dot of 3 px covers.
double in_dot(double x, double y) { return 1 / (1 + std::exp(2 * (std::hypot(x, y) - 3))); }

// Equal dots of 3 px on skin that grows lighter to the right.
DepthScan dotted_scan(const std::vector<std::pair<double, double>>& dots) {
  return drawn_scan([&](double x, double y) {
    double light = 90 + 0.1 * x;
    for (const auto& [dot_x, dot_y] : dots) light += 120 * in_dot(x - dot_x, y - dot_y);
    return light;
  });
}

}  // namespace

TEST(TrackMarkers, FollowsMarkersToTwentiethsOfAPixelAndLosesNone) {
  const auto frames = take(20);
  const Landmarks start = true_start(frames[0]);
  ASSERT_GE(start.points.size(), 35u);
  engine::Prior<TrackMarkersResult> before;
  double square = 0, count = 0;
  for (const auto& frame : frames) {
    const TrackMarkersResult result = track_markers(frame.scan, start, nullptr, before, {}, quiet);
    EXPECT_EQ(result.report, "");
    std::map<std::string, Landmark> truth;
    for (const Landmark& p : stream().marker_truth(frame).points) truth[p.name] = p;
    for (const Landmark& p : result.markers.points) {
      square += std::pow(p.x_px - truth[p.name].x_px, 2) + std::pow(p.y_px - truth[p.name].y_px, 2);
      ++count;
    }
    before = engine::Prior<TrackMarkersResult>(std::make_shared<const TrackMarkersResult>(result));
  }
  EXPECT_LE(std::sqrt(square / count), 0.15);
}

TEST(TrackMarkers, NamesAMarkerThatLeavesThePictureAndKeepsTheRest) {
  const auto frame = stream().frame(stream().weights({}));
  Landmarks start = true_start(frame);
  start.points.resize(6);
  start.points.push_back({"at_the_edge", 5, 240, true});
  const TrackMarkersResult first = track_markers(frame.scan, start, nullptr, {}, {}, quiet);
  DepthScan shifted = frame.scan;
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x)
      shifted.picture.pixels[static_cast<std::size_t>(y * 640 + x)] =
          x + 6 < 640 ? frame.scan.picture.pixels[static_cast<std::size_t>(y * 640 + x + 6)] : std::uint8_t{0};
  Heard heard;
  const engine::Prior<TrackMarkersResult> before(std::make_shared<const TrackMarkersResult>(first));
  const TrackMarkersResult result = track_markers(shifted, start, nullptr, before, {}, heard);
  EXPECT_EQ(result.report, "at_the_edge");
  ASSERT_EQ(heard.texts.size(), 1u);
  EXPECT_EQ(heard.texts[0].substr(0, 61), "marker at_the_edge leaves the picture of 640 x 480 pixels at ");
  EXPECT_FALSE(result.markers.points[6].valid);
  EXPECT_NEAR(result.markers.points[6].x_px, 5 - 6, 0.1);  // goes along with the rest
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(result.markers.points[i].x_px, start.points[i].x_px - 6, 0.02);
}

// Two equal dots, 12 px apart, of a jaw that drops by 11: the upper one's new place is nearly the lower one's old.
TEST(TrackMarkers, DoesNotFollowTheDotOfAnotherMarker) {
  const Landmarks start{{{"lip", 40, 30, true}, {"chin", 40, 42, true}}};
  TrackMarkersResult result = track_markers(dotted_scan({{40, 30}, {40, 42}}), start, nullptr, {}, {}, quiet);
  const auto next = [&](const DepthScan& scan) {
    const engine::Prior<TrackMarkersResult> before(std::make_shared<const TrackMarkersResult>(result));
    result = track_markers(scan, start, nullptr, before, {}, quiet);
  };
  next(dotted_scan({{40, 34}, {40, 53}}));
  EXPECT_EQ(result.report, "");
  EXPECT_NEAR(result.markers.points[0].y_px, 34, 0.1);
  EXPECT_NEAR(result.markers.points[1].y_px, 53, 0.1);
  // A dot that turns out of sight is lost, whatever is near, and found again when it comes back.
  next(dotted_scan({{40, 40}}));
  EXPECT_EQ(result.report, "chin");
  EXPECT_NEAR(result.markers.points[0].y_px, 40, 0.1);
  next(dotted_scan({{40, 46}}));
  EXPECT_EQ(result.report, "chin");
  next(dotted_scan({{40, 48}, {40, 60}}));
  EXPECT_EQ(result.report, "");
  EXPECT_NEAR(result.markers.points[1].y_px, 60, 0.1);
}

// The skin falls to a third of its light, beside skin that stays as it was.
TEST(TrackMarkers, FollowsADotIntoShade) {
  const auto shaded = [](double dot_x, double share) {
    return drawn_scan(
        [=](double x, double y) { return y > 52 ? 90.0 : share * (90 + 120 * in_dot(x - dot_x, y - 44)); });
  };
  const Landmarks start{{{"cheek", 40, 44, true}}};
  TrackMarkersResult result = track_markers(shaded(40, 1), start, nullptr, {}, {}, quiet);
  double x = 40;
  for (const double share : {0.9, 0.7, 0.5, 0.33, 0.33}) {
    x += 1.3;
    const engine::Prior<TrackMarkersResult> before(std::make_shared<const TrackMarkersResult>(result));
    result = track_markers(shaded(x, share), start, nullptr, before, {}, quiet);
    EXPECT_EQ(result.report, "") << share;
    EXPECT_NEAR(result.markers.points[0].x_px, x, 0.1) << share;
    EXPECT_NEAR(result.markers.points[0].y_px, 44, 0.1) << share;
  }
}

// A disc that turns from 0 to 75 degrees and back: its square is bent with it, and is straight again in the end.
TEST(TrackMarkers, FollowsADotThatTurnsAside) {
  const auto turned = [](double width) {
    return drawn_scan([=](double x, double y) { return 90 + 120 * in_dot((x - 40.3) / width, y - 44); });
  };
  const Landmarks start{{{"temple", 40.3, 44, true}}};
  TrackMarkersResult result = track_markers(turned(1), start, nullptr, {}, {}, quiet);
  for (const double width : {0.8, 0.6, 0.45, 0.33, 0.26, 0.26, 0.33, 0.4, 0.6, 0.8, 1.0, 1.0}) {
    const engine::Prior<TrackMarkersResult> before(std::make_shared<const TrackMarkersResult>(result));
    result = track_markers(turned(width), start, nullptr, before, {}, quiet);
    EXPECT_EQ(result.report, "") << width;
    EXPECT_NEAR(result.markers.points[0].x_px, 40.3, 0.1) << width;
    EXPECT_NEAR(result.bends.at(0, 0), width, 0.15);
    EXPECT_NEAR(result.bends.at(0, 3), 1, 0.1);
  }
}

// While a hand covers a marker the head moves on by farther than any search reaches.
TEST(TrackMarkers, FindsAMarkerAgainWhereTheOthersSay) {
  const Landmarks start{{{"brow", 20, 20, true}, {"nose", 30, 26, true}, {"cheek", 22, 40, true}}};
  TrackMarkersResult result = track_markers(dotted_scan({{20, 20}, {30, 26}, {22, 40}}), start, nullptr, {}, {}, quiet);
  for (int t = 1; t <= 9; ++t) {
    const double x = 5 * t, y = 3 * t;
    std::vector<std::pair<double, double>> dots = {{20 + x, 20 + y}, {30 + x, 26 + y}};
    if (t == 9) dots.push_back({22 + x, 40 + y});
    const engine::Prior<TrackMarkersResult> before(std::make_shared<const TrackMarkersResult>(result));
    result = track_markers(dotted_scan(dots), start, nullptr, before, {}, quiet);
    EXPECT_EQ(result.report, t == 9 ? "" : "cheek");
    EXPECT_NEAR(result.markers.points[2].x_px, 22 + x, 0.3);
    EXPECT_NEAR(result.markers.points[2].y_px, 40 + y, 0.3);
  }
}

// From 12 px per scan on each dot's place is where the other one was.
TEST(TrackMarkers, FollowsAJawThatFallsFartherThanTheSearchReaches) {
  const Landmarks start{{{"lip", 40, 12, true}, {"chin", 40, 24, true}}};
  TrackMarkersResult result = track_markers(dotted_scan({{40, 12}, {40, 24}}), start, nullptr, {}, {}, quiet);
  double y = 12;
  for (const double fall : {4.0, 8.0, 12.0, 13.0, 9.0}) {
    y += fall;
    const engine::Prior<TrackMarkersResult> before(std::make_shared<const TrackMarkersResult>(result));
    result = track_markers(dotted_scan({{40, y}, {40, y + 12}}), start, nullptr, before, {}, quiet);
    EXPECT_EQ(result.report, "");
    EXPECT_NEAR(result.markers.points[0].y_px, y, 0.1);
    EXPECT_NEAR(result.markers.points[1].y_px, y + 12, 0.1);
    EXPECT_NEAR(result.moved_px.at(0, 1), fall, 0.1);
  }
}

// A bar is as like a dot as one that is followed may become, and one that was lost is not believed on it.
TEST(TrackMarkers, DoesNotBelieveALostMarkerOnWhatIsALittleLikeIt) {
  const auto bar = [](double, double y) { return 90 + 120 / (1 + std::exp(2 * (std::fabs(y - 44) - 3))); };
  const Landmarks start{{{"jaw", 40, 44, true}}};
  const TrackMarkersResult first = track_markers(dotted_scan({{40, 44}}), start, nullptr, {}, {}, quiet);
  const auto next = [&](const TrackMarkersResult& result, const DepthScan& scan) {
    const engine::Prior<TrackMarkersResult> before(std::make_shared<const TrackMarkersResult>(result));
    return track_markers(scan, start, nullptr, before, {}, quiet);
  };
  EXPECT_EQ(next(first, drawn_scan(bar)).report, "");
  const TrackMarkersResult hidden = next(first, dotted_scan({}));
  EXPECT_EQ(hidden.report, "jaw");
  EXPECT_EQ(next(hidden, drawn_scan(bar)).report, "jaw");
  EXPECT_EQ(next(hidden, dotted_scan({{41, 44}})).report, "");
}

// On moving as it did the lip's marker would be where the chin's dot is now.
TEST(TrackMarkers, FollowsAJawThatSnapsShut) {
  struct Spot {
    const char* name;
    double x, y, fall;  // fall: of the jaw's
  };
  const std::vector<Spot> spots = {
      {"nose", 48, 10, 0}, {"lip", 48, 40, 1}, {"chin", 48, 70, 1}, {"right", 30, 55, 0.6}, {"left", 66, 55, 0.6}};
  const auto scan_of = [&](double fall) {
    std::vector<std::pair<double, double>> dots;
    for (const Spot& spot : spots) dots.push_back({spot.x, spot.y + spot.fall * fall});
    return dotted_scan(dots);
  };
  Landmarks start;
  for (const Spot& spot : spots) start.points.push_back({spot.name, spot.x, spot.y, true});
  TrackMarkersResult result = track_markers(scan_of(0), start, nullptr, {}, {}, quiet);
  for (const double fall : {0.0, 15.0, 1.0, 0.0}) {
    const engine::Prior<TrackMarkersResult> before(std::make_shared<const TrackMarkersResult>(result));
    result = track_markers(scan_of(fall), start, nullptr, before, {}, quiet);
    EXPECT_EQ(result.report, "") << fall;
    for (std::size_t i = 0; i < spots.size(); ++i)
      EXPECT_NEAR(result.markers.points[i].y_px, spots[i].y + spots[i].fall * fall, 0.1) << fall << spots[i].name;
  }
}

TEST(TrackMarkers, TakesACorrection) {
  const auto frame = stream().frame(stream().weights({}));
  const Landmarks start = true_start(frame);
  const Landmarks right{{{start.points[2].name, start.points[2].x_px + 3, start.points[2].y_px - 2, true}}};
  const TrackMarkersResult result = track_markers(frame.scan, start, &right, {}, {}, quiet);
  EXPECT_EQ(result.markers.points[2].x_px, start.points[2].x_px + 3);
  const Landmarks wrong{{{"nobody", 3, 3, true}}};
  EXPECT_THROW_TEXT(track_markers(frame.scan, start, &wrong, {}, {}, quiet),
                    "a correction names the marker nobody, which start does not have");
}

TEST(TrackMarkers, RejectsAStartOutsideTheScan) {
  const auto frame = stream().frame(stream().weights({}));
  EXPECT_THROW_TEXT(track_markers(frame.scan, {{{"a", 700, 20, true}}}, nullptr, {}, {}, quiet),
                    "start marker a is at (700, 20), outside the scan of 640 x 480 pixels");
}

TEST(FindMarkers, FindsThePaintedDotsAndNothingElseOnTheSkin) {
  const auto frame = stream().frame(stream().weights({}));
  const Landmarks found = find_markers(engine::Seq<DepthScan>({frame.scan}));
  // Of 55, of which a dozen lies at the edge, in shadow or in a crease; one at the jaw is 0.303 px off in place of 0.3.
  EXPECT_GE(true_start(frame).points.size(), 39u);
  for (const Landmark& f : found.points) {
    double nearest = 1e9;
    for (const Landmark& t : stream().marker_truth(frame).points)
      nearest = std::min(nearest, std::hypot(t.x_px - f.x_px, t.y_px - f.y_px));
    EXPECT_LE(nearest, 3) << f.name;
  }
}

// On a side that falls into shade, with a brow's edge in the ring about it.
TEST(MeasureDot, IsNotPulledByShadeOrHair) {
  const DepthScan scan = drawn_scan([](double x, double y) {
    const double skin = y < 38.5 ? 30 : 120 - 2.5 * (x - 40);
    return skin * (1 + 0.4 * in_dot(x - 40.3, y - 43.8));
  });
  const Dot dot = measure_dot(scan.picture, 40, 44, 3);
  EXPECT_NEAR(dot.x_px, 40.3, 0.06);
  EXPECT_NEAR(dot.y_px, 43.8, 0.06);
  EXPECT_NEAR(dot.length_px, 1.5, 0.2);  // half of the radius of a disc
  EXPECT_NEAR(dot.width_px, dot.length_px, 0.1);
}

TEST(MeasureDot, MeasuresDarkDotsAndSlantedOnes) {
  const DepthScan scan = drawn_scan([](double x, double y) { return 180 - 110 * in_dot((x - 40.4) / 0.4, y - 44.2); });
  const Dot dot = measure_dot(scan.picture, 40, 44, 3);
  EXPECT_NEAR(dot.x_px, 40.4, 0.03);
  EXPECT_NEAR(dot.y_px, 44.2, 0.03);
  EXPECT_NEAR(dot.width_px / dot.length_px, 0.4, 0.1);
}

// A radius too small finds noise, which was linked for hours.
TEST(FindMarkers, RefusesMoreDotsThanAnybodyPaints) {
  const DepthScan scan = drawn_scan(
      [](double x, double y) { return std::hypot(std::fmod(x, 5) - 2, std::fmod(y, 5) - 2) < 1 ? 220.0 : 90.0; });
  EXPECT_THROW_TEXT(find_markers(engine::Seq<DepthScan>({scan}), {.radius_px = 1}),
                    "the take's first scan shows 324 dots, expected at most 250: is radius_px 1 px the radius of the "
                    "painted ones, and least_contrast 18 more than noise?");
}

TEST(FindMarkers, TakesNoTeethBetweenLipsForADot) {
  const DepthScan scan = drawn_scan([](double x, double y) {
    const double lips = std::hypot((x - 48) / 3, y - 60) < 8 ? 70 : 150;
    return lips + 110 / (1 + std::exp(4 * (std::hypot((x - 48) / 6, y - 60) - 0.6))) + 80 * in_dot(x - 30.2, y - 30.4);
  });
  const Landmarks found = find_markers(engine::Seq<DepthScan>({scan}));
  ASSERT_EQ(found.points.size(), 1u);
  EXPECT_NEAR(found.points[0].x_px, 30.2, 0.05);
  EXPECT_NEAR(found.points[0].y_px, 30.4, 0.05);
}

TEST(LinkMarkers, GivesTheReferencesNamesToAnotherTakesMarkers) {
  const auto a = stream().frame(stream().weights({})),
             b = stream().frame(stream().weights({{"jawOpen", 0.2f}}), motion_of(0.06, -0.04, 6, -4, 3));
  const Landmarks reference = stream().marker_truth(a);
  Landmarks other = find_markers(engine::Seq<DepthScan>({b.scan}));
  const Landmarks linked = link_markers(other, reference);
  std::map<std::string, Landmark> truth;
  for (const Landmark& p : stream().marker_truth(b).points) truth[p.name] = p;
  EXPECT_GE(linked.points.size(), 40u);
  for (const Landmark& p : linked.points)
    EXPECT_LE(std::hypot(p.x_px - truth[p.name].x_px, p.y_px - truth[p.name].y_px), 4) << p.name;
}

TEST(AbsoluteOrientation, RecoversAKnownMotion) {
  const RigidMotion m = motion_of(0.3, -0.2, 5, 6, 7);
  const std::vector<std::array<double, 3>> from = {{0, 0, 0}, {10, 0, 2}, {3, 8, -1}, {-4, 5, 6}};
  std::vector<std::array<double, 3>> to;
  for (const auto& p : from) {
    std::array<double, 3> q{};
    for (std::size_t r = 0; r < 3; ++r) {
      q[r] = m.translation_mm[r];
      for (std::size_t c = 0; c < 3; ++c) q[r] += m.rotation[r * 3 + c] * p[c];
    }
    to.push_back(q);
  }
  const AbsoluteOrientation found = absolute_orientation(from, to, {1, 2, 1, 0.5});
  ASSERT_TRUE(found.solved);
  EXPECT_LE(found.rms_mm, 1e-12);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(found.to_from.rotation[i], m.rotation[i], 1e-12);
}

TEST(AbsoluteOrientation, ReportsPointsOnALineAsUnsolved) {
  const std::vector<std::array<double, 3>> line = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}};
  EXPECT_FALSE(absolute_orientation(line, line, {1, 1, 1, 1}).solved);
  EXPECT_FALSE(absolute_orientation({{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {1, 0, 0}}, {1, 1}).solved);
}

TEST(Orient, BringsAScanBackEvenWithLostAndMistakenMarkers) {
  const auto reference = stream().frame(stream().weights({{"jawOpen", 0.15f}}));
  const RigidMotion motion = motion_of(0.08, 0.05, 4, -3, 6);
  const auto frame = stream().frame(stream().weights({{"jawOpen", 0.5f}}), motion);
  const Landmarks there = true_start(reference);
  Landmarks here = true_start(frame);
  here.points[0].valid = false;
  here.points[5].x_px += 12;
  here.points[9].y_px -= 9;
  const OrientResult result = orient(frame.scan, here, reference.scan, there, {}, quiet);
  ASSERT_TRUE(result.solved);
  EXPECT_LE(result.rms_mm, 0.3);
  // A point of the forehead comes back to where it was.
  for (const Vec3f& p : {Vec3f{0, 60, 90}, Vec3f{40, 30, 70}, Vec3f{-40, 0, 60}}) {
    double worst = 0;
    for (std::size_t r = 0; r < 3; ++r) {
      double moved[3] = {0, 0, 0};
      for (std::size_t k = 0; k < 3; ++k) {
        moved[k] = motion.translation_mm[k];
        for (std::size_t c = 0; c < 3; ++c) moved[k] += motion.rotation[k * 3 + c] * static_cast<double>(p[c]);
      }
      double back = result.reference_from_scan.translation_mm[r];
      for (std::size_t c = 0; c < 3; ++c) back += result.reference_from_scan.rotation[r * 3 + c] * moved[c];
      worst = std::max(worst, std::fabs(back - static_cast<double>(p[r])));
    }
    EXPECT_LE(worst, 0.4);
  }
}

// Markers of the forehead move with the brows.
TEST(Orient, KeepsTheMouthInItsPlaceWhileBrowsRise) {
  const auto reference = stream().frame(stream().weights({{"jawOpen", 0.15f}}));
  const auto frame = stream().frame(stream().weights(
      {{"jawOpen", 0.15f}, {"browInnerUp", 0.45f}, {"browOuterUpLeft", 0.4f}, {"browOuterUpRight", 0.4f}}));
  const OrientResult result = orient(frame.scan, true_start(frame), reference.scan, true_start(reference), {}, quiet);
  ASSERT_TRUE(result.solved);
  const std::array<double, 3> mouth = {0, -60, 60};
  double moved = 0;
  for (std::size_t r = 0; r < 3; ++r) {
    double back = result.reference_from_scan.translation_mm[r] - mouth[r];
    for (std::size_t c = 0; c < 3; ++c) back += result.reference_from_scan.rotation[r * 3 + c] * mouth[c];
    moved += back * back;
  }
  EXPECT_LE(std::sqrt(moved), 0.06);
}

TEST(Orient, LeavesAScanWithTooFewMarkersWhereItIs) {
  const auto frame = stream().frame(stream().weights({}));
  const Landmarks two{{{"a", 300, 100, true}, {"b", 340, 110, true}}};
  Heard heard;
  const OrientResult result = orient(frame.scan, two, frame.scan, two, {}, heard);
  EXPECT_FALSE(result.solved);
  EXPECT_EQ(heard.texts, (std::vector<std::string>{
                             "the head's motion is not known: of 2 markers that the jaw does not move 2 are measured, "
                             "and no three of them agree with the reference; left out"}));
  EXPECT_EQ(result.aligned.camera.position_mm, frame.scan.camera.position_mm);
  heard.texts.clear();
  EXPECT_FALSE(orient(frame.scan, {}, frame.scan, {}, {}, heard).solved);
  EXPECT_EQ(heard.texts,
            (std::vector<std::string>{"the head's motion is not known: the reference has no markers, expected painted "
                                      "dots of about the radius that align.find_markers is told; left out"}));
}

TEST(FitAxis, FindsTheAxisOfACylinder) {
  // A cylinder of radius 70 about (12, ., 5), seen from z = 1000.
  DepthScan scan;
  scan.camera.position_mm = {0, 0, 1000};
  scan.camera.focal_px = 1500;
  scan.camera.centre_x_px = scan.camera.centre_y_px = 159.5f;
  scan.picture = {320, 320, 1, std::vector<std::uint8_t>(320 * 320, 100)};
  for (int y = 0; y < 320; ++y)
    for (int x = 0; x < 320; ++x) {
      // Ray (sx, ., -1) from the pinhole: |(sx t - 12, 995 - t)| = 70.
      const double sx = (x - 159.5) / 1500, a = sx * sx + 1, b = -2 * (12 * sx + 995), c = 144 + 995.0 * 995 - 4900;
      const double d = b * b - 4 * a * c;
      scan.depth_mm.push_back(d > 0 ? static_cast<float>((-b - std::sqrt(d)) / (2 * a)) : 0.0f);
    }
  const FitAxisResult result = fit_axis(scan);
  EXPECT_NEAR(result.axis.origin_mm[0], 12, 0.5);
  EXPECT_NEAR(result.axis.origin_mm[2], 5, 3);
  EXPECT_NEAR(result.mean_radius_mm, 70, 3);
  EXPECT_GE(result.axis.direction[1], 0.999f);
}

TEST(Crop, KeepsWhatAllScansHave) {
  const auto a = stream().frame(stream().weights({}));
  DepthScan half = a.scan;
  for (int y = 0; y < 480; ++y)
    for (int x = 330; x < 640; ++x) half.depth_mm[static_cast<std::size_t>(y * 640 + x)] = 0;
  const Axis axis = fit_axis(a.scan).axis;
  const Image common =
      common_cover(engine::Seq<Image>({cover(a.scan, axis), cover(half, axis)}), {.share = 1, .shrink_cells = 0});
  const DepthScan cropped = crop(a.scan, axis, common);
  std::size_t left = 0, right = 0;
  for (int y = 150; y < 350; ++y)
    for (int x = 0; x < 640; ++x)
      (x < 325 ? left : right) += cropped.depth_mm[static_cast<std::size_t>(y * 640 + x)] > 0 ? 1 : 0;
  EXPECT_GE(left, 15000u);
  EXPECT_LE(right, 2000u);
}

TEST(Crop, RejectsNoScansAndMasksOfAnotherSize) {
  EXPECT_THROW_TEXT(common_cover(engine::Seq<Image>()), "covers is empty, expected at least one scan");
  const auto a = stream().frame(stream().weights({}));
  EXPECT_THROW_TEXT(crop(a.scan, {}, {3, 2, 1, std::vector<std::uint8_t>(6, 0)}),
                    "mask is 3 x 2 cells, expected 180 x 160");
  EXPECT_THROW_TEXT(crop(a.scan, {}, {180, 160, 1, {}}),
                    "mask has 0 values in 1 channels, expected one for each of 180 x 160 cells");
}

TEST(ChooseReference, TakesASlightlyOpenMouthOrTheNamedFrame) {
  std::vector<DepthScan> scans(5);
  std::vector<Landmarks> markers(5, Landmarks{{{"a", 1, 1, true}, {"b", 2, 2, true}}});
  std::vector<Image> interiors;
  for (const int area : {0, 3, 10, 9, 4}) {
    interiors.push_back({10, 1, 1, std::vector<std::uint8_t>(10, 0)});
    for (int i = 0; i < area; ++i) interiors.back().pixels[static_cast<std::size_t>(i)] = 255;
  }
  markers[1].points[1].valid = false;
  const auto choose = [&](const std::string& frame) {
    return choose_reference(engine::Seq<DepthScan>(scans), engine::Seq<Landmarks>(markers),
                            engine::Seq<Image>(interiors), {.frame = frame})
        .frame;
  };
  EXPECT_EQ(choose(""), "4");
  EXPECT_EQ(choose("2"), "2");
  // One of ten markers out of sight does not count against a frame, two do.
  for (Landmarks& frame : markers)
    while (frame.points.size() < 10) frame.points.push_back({"c", 3, 3, true});
  markers[4].points[0].valid = markers[4].points[2].valid = false;
  EXPECT_EQ(choose(""), "1");
  EXPECT_THROW_TEXT(choose("7"), "frame is \"7\", which no scan has; the first is \"0\", the last \"4\"");
}

TEST(FirstLayout, TakesTheFirstOfThoseWithTheMostMarkers) {
  const Landmarks one{{{"a", 1, 1, true}}}, two{{{"b", 1, 1, true}, {"c", 2, 2, true}}},
      other{{{"d", 1, 1, true}, {"e", 2, 2, true}}};
  EXPECT_EQ(first_layout(engine::Seq<Landmarks>({one, two, other})).points[0].name, "b");
  EXPECT_TRUE(first_layout(engine::Seq<Landmarks>()).points.empty());
}
