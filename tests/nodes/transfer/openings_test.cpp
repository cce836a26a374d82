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
#include "nodes/transfer/opening_sheet.h"
#include "tests/support/blinking_eye.h"
#include "tests/support/expect_throw_text.h"

namespace face::transfer {
namespace {

using test::eye_outline, test::eye_scan, test::eye_shape;

double squares(const Image& drawn, const Image& seen) {
  double sum = 0;
  for (int y = 22; y < 58; ++y)
    for (int x = 22; x < 68; ++x) {
      const auto i = static_cast<std::size_t>(y * test::eye_columns + x);
      sum += std::pow(static_cast<double>(drawn.pixels[i]) - seen.pixels[i], 2);
    }
  return sum;
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
  Outline outline;
  for (const Landmark& p : eye_outline().points) outline.corners.push_back({p.x_px, p.y_px});
  const OpeningSheet sheet = opening_sheet(outline);
  const OpeningLayers layers = opening_layers(reference.picture, outline);
  const OpeningScene scene(sheet, layers);
  OpeningPose pose;
  pose.vertices = sheet.places;
  pose.light.assign(static_cast<std::size_t>(scene.light_columns() * scene.light_rows()), 0);
  const OpeningView view = scene.view(pose);
  double sum = 0, count = 0;
  for (int y = 22; y < 58; ++y)
    for (int x = 22; x < 68; ++x) {
      ASSERT_TRUE(view.at(x, y).drawn);
      sum += std::pow(
          view.at(x, y).grey - reference.picture.pixels[static_cast<std::size_t>(y * test::eye_columns + x)], 2);
      ++count;
    }
  EXPECT_LT(std::sqrt(sum / count), 2.5);
  // More light on the skin leaves the eye as it is.
  std::fill(pose.light.begin(), pose.light.end(), 0.2);
  const OpeningView lighter = scene.view(pose);
  EXPECT_GT(lighter.at(45, 25).grey, view.at(45, 25).grey + 5);
  EXPECT_EQ(lighter.at(45, 40).grey, view.at(45, 40).grey);
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
  EXPECT_LT(worst, 2.0);
  // One frame may be wrong; a stream that shuts nothing has no openings.
  EXPECT_TRUE(find_openings(mesh, reference, engine::Seq<MeshPoints>({open, open, shut}), frames).points.empty());
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
