// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/transfer/draw_openings.h"
#include "nodes/transfer/draw_texture.h"
#include "nodes/transfer/find_openings.h"
#include "nodes/transfer/fit_opening.h"
#include "nodes/transfer/opening_scene.h"
#include "nodes/transfer/pixel_parts.h"
#include "nodes/transfer/share_slopes.h"
#include "tests/support/blinking_eye.h"
#include "tests/support/expect_throw_text.h"

namespace face::transfer {
namespace {

using test::eye_outline, test::eye_scan, test::eye_shape;

// Where the lids move, and a little beyond.
constexpr int first_x = 27, last_x = 63, first_y = 28, last_y = 52;

double squares(const Image& drawn, const Image& seen) {
  double sum = 0;
  for (int y = first_y; y < last_y; ++y)
    for (int x = first_x; x < last_x; ++x) {
      const auto i = static_cast<std::size_t>(y * test::eye_columns + x);
      sum += std::pow(static_cast<double>(drawn.pixels[i]) - seen.pixels[i], 2);
    }
  return sum;
}

Outline eye_curve() {
  Outline outline;
  for (const Landmark& p : eye_outline().points) outline.corners.push_back({p.x_px, p.y_px});
  return outline;
}

// As the reference has it.
OpeningPose pose_of(const OpeningScene& scene) {
  OpeningPose pose;
  pose.vertices = scene.sheet().places;
  pose.light.assign(static_cast<std::size_t>(scene.light_columns() * scene.light_rows()), 0);
  return pose;
}

double squares(const OpeningScene& scene, const OpeningPose& pose, const Image& seen) {
  const OpeningView view = scene.view(pose);
  double sum = 0;
  for (int y = first_y; y < last_y; ++y)
    for (int x = first_x; x < last_x; ++x)
      sum += std::pow(view.at(x, y).grey - seen.pixels[static_cast<std::size_t>(y * test::eye_columns + x)], 2);
  return sum;
}

// Lids open by a share q, below 0 one over the other; the upper one some pixels lower.
OpeningPose shut_pose(const OpeningScene& scene, double q, double upper_px = 0) {
  OpeningPose pose = pose_of(scene);
  for (Place& p : pose.vertices) {
    const double x = p[0] - test::eye_x, y = p[1] - test::eye_y;
    const double to = test::skin_to(x, std::fabs(y), q);
    p[1] = test::eye_y + (y < 0 ? upper_px - to : to);
  }
  return pose;
}

}  // namespace

TEST(Outline, TellsHowFarAPlaceIsInsideOrOutside) {
  const Outline square{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
  Place nearest{};
  EXPECT_DOUBLE_EQ(square.distance({5, 8}, &nearest), -2);
  EXPECT_DOUBLE_EQ(nearest[1], 10);
  EXPECT_DOUBLE_EQ(square.distance({13, 14}), 5);
}

TEST(OpeningScene, OfTheReferenceIsTheReference) {
  const DepthScan reference = eye_scan(1);
  const Outline outline = eye_curve();
  const OpeningSheet sheet = opening_sheet(outline);
  const OpeningLayers layers = opening_layers(reference.picture, outline);
  const OpeningScene scene(sheet, layers);
  OpeningPose pose = pose_of(scene);
  const OpeningView view = scene.view(pose);
  double sum = 0, count = 0;
  for (int y = first_y; y < last_y; ++y)
    for (int x = first_x; x < last_x; ++x) {
      ASSERT_TRUE(view.at(x, y).drawn);
      sum += std::pow(
          view.at(x, y).grey - reference.picture.pixels[static_cast<std::size_t>(y * test::eye_columns + x)], 2);
      ++count;
    }
  EXPECT_LT(std::sqrt(sum / count), 2.5);
  // More light on the skin leaves the eye as it is.
  std::fill(pose.light.begin(), pose.light.end(), 0.2);
  const OpeningView lighter = scene.view(pose);
  EXPECT_GT(lighter.at(45, 30).grey, view.at(45, 30).grey + 5);
  EXPECT_EQ(lighter.at(45, 40).grey, view.at(45, 40).grey);
}

// A slit of less than a pixel: its upper lid a little lower covers more of every pixel that sees the slit.
TEST(ShareSlopes, TellHowMuchMoreALidCoversWhereItMoves) {
  const Outline outline = eye_curve();
  const OpeningSheet sheet = opening_sheet(outline);
  const OpeningLayers layers = opening_layers(eye_scan(1).picture, outline);
  const OpeningScene scene(sheet, layers);
  // Sums of squares of what is foretold, of what it is, and of what the two differ by.
  const auto change = [&](double q, int left = first_x, int right = last_x) {
    constexpr double step_px = 0.5;
    const OpeningPose pose = shut_pose(scene, q);
    const OpeningView view = scene.view(pose), before = scene.view(shut_pose(scene, q, -0.5 * step_px)),
                      after = scene.view(shut_pose(scene, q, 0.5 * step_px));
    const auto slopes = share_slopes(sheet, pose, view);
    std::array<double, 3> squares{};
    for (int y = first_y; y < last_y; ++y)
      for (int x = left; x < right; ++x) {
        double foretold = 0;
        for (const ShareSlope& s : slopes[view.index(x, y)])
          foretold += sheet.places[s.vertex][1] < test::eye_y ? step_px * s.slope[1] : 0;
        const double is = after.at(x, y).share - before.at(x, y).share;
        squares[0] += foretold * foretold;
        squares[1] += is * is;
        squares[2] += std::pow(foretold - is, 2);
      }
    return squares;
  };
  for (const double q : {0.1, 0.5}) {
    const auto [foretold, is, off] = change(q);
    EXPECT_GT(is, 1) << q;
    EXPECT_LT(off, 0.05 * is) << q;
  }
  // Over the other lid, between the corners, it covers nothing.
  EXPECT_EQ(change(-0.3, 38, 52)[0], 0);
}

TEST(FitOpening, MovesLidsToWhereTheFrameHasThem) {
  const Outline outline = eye_curve();
  const OpeningSheet sheet = opening_sheet(outline);
  const OpeningLayers layers = opening_layers(eye_scan(1).picture, outline);
  const OpeningScene scene(sheet, layers);
  const Image seen = eye_scan(0.2).picture;
  const OpeningPose from = shut_pose(scene, 0.5);
  EXPECT_LT(squares(scene, fit_opening(scene, seen, from, from).pose, seen), 0.05 * squares(scene, from, seen));
}

TEST(FindOpenings, FindsTheEyeThatAStreamShuts) {
  const DepthScan reference = eye_scan(1);
  const Mesh mesh = test::eye_mesh();
  const MeshPoints open{mesh.points_mm}, shut = eye_shape(mesh, 0.02);
  const engine::Seq<DepthScan> frames({reference, reference, reference});
  const Landmarks found = find_openings(mesh, reference, engine::Seq<MeshPoints>({open, shut, shut}), frames);
  ASSERT_GT(found.points.size(), 30u);
  EXPECT_EQ(found.points.front().name, "1.0");
  const std::string last = found.points.back().name;
  EXPECT_EQ(last.substr(0, 2), "1.");
  double worst = 0;
  for (const Landmark& p : found.points) {
    const double x = p.x_px - test::eye_x, y = p.y_px - test::eye_y;
    const double radius = std::hypot(x / test::eye_half_width, y / test::eye_half_height);
    worst = std::max(worst, std::fabs(radius - 1) * std::hypot(x, y));
  }
  EXPECT_LT(worst, 1.0);
  // One frame may be wrong; a stream that shuts nothing has no openings.
  EXPECT_TRUE(find_openings(mesh, reference, engine::Seq<MeshPoints>({open, open, shut}), frames).points.empty());
}

TEST(FindOpenings, TakesNothingForAnEyeThatLiesAtTheMeshsEdge) {
  DepthScan reference = eye_scan(1);
  const Mesh mesh = test::eye_mesh();
  const MeshPoints shut = eye_shape(mesh, 0.02);
  const engine::Seq<DepthScan> frames({reference, reference});
  const engine::Seq<MeshPoints> shapes({shut, shut});
  ASSERT_FALSE(find_openings(mesh, reference, shapes, frames).points.empty());
  // What hides there is a lip: nothing is measured in the opening's middle.
  reference.depth_mm[static_cast<std::size_t>(40 * test::eye_columns + 45)] = 0;
  EXPECT_TRUE(find_openings(mesh, reference, shapes, frames).points.empty());
}

TEST(PixelParts, HangTogetherByCornersAndAreWalkedAroundOnce) {
  PixelFlags flags(12, 9);
  for (int y = 2; y < 5; ++y)
    for (int x = 3; x < 7; ++x) flags.set(x, y, true);
  flags.set(7, 5, true);
  flags.set(10, 7, true);
  const std::vector<Pixels> parts = parts_of(flags);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].size(), 13u);
  EXPECT_EQ(border_of(parts[1]), (Pixels{{10, 7}}));
  // Clockwise, out to the pixel that hangs by a corner and back; the two pixels within are no border.
  EXPECT_EQ(border_of(parts[0]),
            (Pixels{{3, 2}, {4, 2}, {5, 2}, {6, 2}, {6, 3}, {6, 4}, {7, 5}, {6, 4}, {5, 4}, {4, 4}, {3, 4}, {3, 3}}));
}

TEST(PixelParts, GrowAndShrinkByARadius) {
  PixelFlags flags(9, 9);
  flags.set(4, 4, true);
  const PixelFlags grown = flags.grown(2);
  EXPECT_TRUE(grown.at(4, 6));
  EXPECT_FALSE(grown.at(6, 6));
  EXPECT_TRUE(grown.shrunk(2).at(4, 4));
  EXPECT_FALSE(grown.shrunk(2).at(4, 5));
}

TEST(OpeningAxis, GoesFromCornerToCornerOfATiltedEye) {
  Outline eye;
  const double tilt = 0.4;
  for (int i = 0; i < 60; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 60, x = 20 * std::cos(angle), y = 8 * std::sin(angle);
    eye.corners.push_back({50 + x * std::cos(tilt) - y * std::sin(tilt), 40 + x * std::sin(tilt) + y * std::cos(tilt)});
  }
  const OpeningAxis axis = opening_axis(eye);
  EXPECT_NEAR(axis.length, 40, 0.1);
  EXPECT_NEAR(axis.along[1] / axis.along[0], std::tan(tilt), 0.01);
  EXPECT_NEAR(axis.own({50 - 3 * std::sin(tilt), 40 + 3 * std::cos(tilt)})[1], 3, 0.01);
  const Place there = axis.picture(axis.own({61, 33}));
  EXPECT_NEAR(there[0], 61, 1e-9);
  EXPECT_NEAR(there[1], 33, 1e-9);
}

// The same eye in a picture twice as large has twice the skin about it.
TEST(OpeningSheet, GrowsWithTheEye) {
  const Outline eye = eye_curve();
  Outline large;
  for (const Place& p : eye.corners) large.corners.push_back(2 * p);
  const OpeningSheet once = opening_sheet(eye), twice = opening_sheet(large);
  EXPECT_NEAR(twice.columns, 2 * once.columns, 3);
  EXPECT_NEAR(twice.rows, 2 * once.rows, 3);
  EXPECT_DOUBLE_EQ(twice.light_px, 2 * once.light_px);
}

// Lids move across an eye: the skin reaches farther there, also about an eye that stands upright.
TEST(OpeningSheet, ReachesFartherAcrossAnEyeThanAlongIt) {
  const Outline lying = eye_curve();
  Outline standing;
  for (const Place& p : lying.corners) standing.corners.push_back({p[1], p[0]});
  const OpeningSheet sheet = opening_sheet(lying), turned = opening_sheet(standing);
  const double columns_px = sheet_stride_px * (sheet.columns - 1), rows_px = sheet_stride_px * (sheet.rows - 1);
  EXPECT_GE(rows_px - 2 * test::eye_half_height, columns_px - 2 * test::eye_half_width + 2);
  EXPECT_NEAR(turned.columns, sheet.rows, 1);
  EXPECT_NEAR(turned.rows, sheet.columns, 1);
}

// A vertex so near to the outline that its triangles would be slivers is put on it.
TEST(OpeningSheet, HasNoVertexNextToTheEye) {
  const Outline eye = eye_curve();
  for (const Place& p : opening_sheet(eye).places) {
    const double away = eye.distance(p);
    EXPECT_TRUE(away < 0.1 || away > 0.5) << away;
  }
}

// Every place of the sheet is outside of the eye, and its triangles leave out the eye's area and nothing else.
TEST(OpeningSheet, HasAHoleWhereTheEyeIs) {
  const Outline eye = eye_curve();
  const OpeningSheet sheet = opening_sheet(eye);
  double area = 0;
  for (const render::Triangle& t : sheet.triangles) {
    const Place &a = sheet.places[t[0]], &b = sheet.places[t[1]], &c = sheet.places[t[2]];
    area += 0.5 * std::fabs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
    EXPECT_GT(eye.distance({(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3}), -0.5);
  }
  const double whole = 4.0 * (sheet.columns - 1) * (sheet.rows - 1);
  EXPECT_NEAR(whole - area, 3.14159 * test::eye_half_width * test::eye_half_height, 4);  // a corner is snapped or cut
}

TEST(FindOpenings, RejectsOtherNumbersOfFrames) {
  const DepthScan reference = eye_scan(1);
  const Mesh mesh = test::eye_mesh();
  EXPECT_THROW_TEXT(find_openings(mesh, reference, engine::Seq<MeshPoints>({MeshPoints{mesh.points_mm}}),
                                  engine::Seq<DepthScan>(std::vector<DepthScan>())),
                    "shapes has 1 elements, frames 0");
}

TEST(DrawOpenings, ShowsLidsWhereTheFrameHasThem) {
  const DepthScan reference = eye_scan(1);
  const Mesh mesh = test::eye_mesh();
  for (const double q : {0.0, 0.4}) {
    const DepthScan frame = eye_scan(q);
    const MeshPoints shape = eye_shape(mesh, q + 0.15);  // a flow that is a pixel off
    const Image by_mesh = draw_texture(mesh, reference, shape, frame).drawn;
    const Image drawn = draw_openings(by_mesh, eye_outline(), mesh, reference, nullptr, shape, frame);
    EXPECT_LT(squares(drawn, frame.picture), 0.3 * squares(by_mesh, frame.picture)) << q;
  }
}

TEST(DrawOpenings, DrawsAnotherTextureWhereTheFrameSaysItIs) {
  const DepthScan reference = eye_scan(1), frame = eye_scan(0.3);
  const auto darker = [](DepthScan scan) {
    for (std::uint8_t& p : scan.picture.pixels) p = static_cast<std::uint8_t>(p / 2);
    return scan;
  };
  const DepthScan texture = darker(reference), wanted = darker(frame);
  const Mesh mesh = test::eye_mesh();
  const MeshPoints shape = eye_shape(mesh, 0.45);
  const Image by_mesh = draw_texture(mesh, texture, shape, frame).drawn;
  const Image drawn = draw_openings(by_mesh, eye_outline(), mesh, reference, &texture, shape, frame);
  EXPECT_LT(squares(drawn, wanted.picture), 0.4 * squares(by_mesh, wanted.picture));
}

TEST(DrawOpenings, LeavesAnEyeThatIsOpenAsItIs) {
  const DepthScan reference = eye_scan(1);
  const Mesh mesh = test::eye_mesh();
  const MeshPoints shape = eye_shape(mesh, 0.9);
  const Image by_mesh = draw_texture(mesh, reference, shape, reference).drawn;
  EXPECT_EQ(draw_openings(by_mesh, eye_outline(), mesh, reference, nullptr, shape, reference).pixels, by_mesh.pixels);
}

TEST(DrawOpenings, RejectsADrawingOfAnotherSize) {
  const DepthScan reference = eye_scan(1);
  const Mesh mesh = test::eye_mesh();
  EXPECT_THROW_TEXT(draw_openings({2, 2, 1, {0, 0, 0, 0}}, {}, mesh, reference, nullptr, {mesh.points_mm}, reference),
                    "drawn is 2 x 2 x 1, frame 90 x 80 x 1");
  const Landmarks few{{{"1.0", 0, 0, true}, {"1.1", 4, 0, true}, {"1.2", 0, 4, true}}};
  const Image drawn = draw_texture(mesh, reference, {mesh.points_mm}, reference).drawn;
  EXPECT_THROW_TEXT(draw_openings(drawn, few, mesh, reference, nullptr, {mesh.points_mm}, reference),
                    "opening 1 has 3 points, expected 8 or more");
}

}  // namespace face::transfer
