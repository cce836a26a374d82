// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/chain_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "nodes/track/face_flow.h"
#include "tests/support/expect_throw_text.h"

namespace face::track {
namespace {

constexpr int width = 60, height = 50;
using Field = std::function<Vec2f(double, double)>;

FlowField field(const Field& at) {
  FlowField flow{width, height, {}, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) flow.displacement_px.push_back(at(x, y));
  flow.valid.assign(flow.displacement_px.size(), 1);
  return flow;
}
FlowField still() {
  return field([](double, double) { return Vec2f{0, 0}; });
}
FlowField shift(double x, double y) {
  return field([=](double, double) { return Vec2f{static_cast<float>(x), static_cast<float>(y)}; });
}
Landmarks two_points() { return {{{"00", 20, 20, true}, {"48", 30.25, 25.5, true}}}; }

// Runs the tracker over frames; `first` may be shorter than `flows`, `corrections` holds null where there is none.
std::vector<ChainFlowResult> run(const std::vector<FlowField>& flows, const std::vector<FlowField>& first,
                                 const std::vector<const Landmarks*>& corrections = {},
                                 const ChainFlowOptions& options = {}) {
  std::vector<ChainFlowResult> results;
  for (std::size_t t = 0; t < flows.size(); ++t) {
    const auto before = t > 0 ? engine::Prior<ChainFlowResult>(std::make_shared<const ChainFlowResult>(results.back()))
                              : engine::Prior<ChainFlowResult>();
    results.push_back(chain_flow(flows[t], t < first.size() ? &first[t] : nullptr, two_points(),
                                 t < corrections.size() ? corrections[t] : nullptr, before, options));
  }
  return results;
}

TEST(ChainFlow, GoesWhereTheFlowsTakeItsPoints) {
  const auto found = run({still(), shift(1, 0.5), shift(-0.25, 2)}, {});
  EXPECT_EQ(found[0].landmarks.points[1].x_px, 30.25);
  EXPECT_NEAR(found[2].landmarks.points[0].x_px, 20.75, 1e-6);
  EXPECT_NEAR(found[2].landmarks.points[1].y_px, 28, 1e-6);
  EXPECT_TRUE(found[2].landmarks.points[0].valid);
}

TEST(ChainFlow, ReadsBetweenPixels) {
  const FlowField slope = field([](double x, double y) {
    return Vec2f{static_cast<float>(0.1 * x), static_cast<float>(0.2 * y)};
  });
  const auto found = run({still(), slope}, {});
  EXPECT_NEAR(found[1].landmarks.points[1].x_px, 30.25 * 1.1, 1e-5);
  EXPECT_NEAR(found[1].landmarks.points[1].y_px, 25.5 * 1.2, 1e-5);
}

TEST(ChainFlow, OfHalfSizeCountsPixelsTwice) {
  ChainFlowOptions options;
  options.half_size = true;
  const FlowField slope = field([](double x, double) { return Vec2f{static_cast<float>(0.1 * x), 0}; });
  const auto found = run({still(), slope}, {}, {}, options);
  // Pixel i of the half lies at 2 i + 0.5.
  EXPECT_NEAR(found[1].landmarks.points[0].x_px, 20 + 2 * 0.1 * (20 - 0.5) / 2, 1e-5);
}

TEST(ChainFlow, IsPulledToTheFlowFromTheFirstFrame) {
  // Chains that drift by 0.1 px a frame, although nothing moves.
  std::vector<FlowField> drifting(41, shift(0.1, 0)), first(41, still());
  drifting[0] = still();
  EXPECT_NEAR(run(drifting, {})[40].landmarks.points[0].x_px, 24, 1e-4);
  // Where 0.1 px come and 0.3 of the difference goes: 0.1 (1 - 0.3) / 0.3.
  ChainFlowOptions options;
  options.pull = 0.3;
  const auto held = run(drifting, first, {}, options);
  EXPECT_NEAR(held[40].landmarks.points[0].x_px, 20 + 0.07 / 0.3, 1e-3);
  EXPECT_NEAR(held[40].pulled_px, 0.1 / 0.3, 1e-3);
}

TEST(ChainFlow, AFlowThatHasLostThePointDoesNotPull) {
  const auto found = run({still(), still()}, {still(), shift(28, 0)});
  EXPECT_EQ(found[1].landmarks.points[0].x_px, 20);
  EXPECT_EQ(found[1].pulled_px, 0);
}

TEST(ChainFlow, ACorrectionGoesOnFromItsFrameToTheNextOne) {
  const std::vector<FlowField> flows = {still(), shift(1, 0), shift(1, 0), shift(1, 0), shift(1, 0)};
  std::vector<FlowField> first;
  for (int t = 0; t < 5; ++t) first.push_back(shift(t, 0));
  const Landmarks at_2{{{"48", 35, 24, true}}}, at_2b{{{"48", 5, 6, true}}}, at_4{{{"48", 40, 30, true}}};
  const auto plain = run(flows, first), fixed = run(flows, first, {nullptr, nullptr, &at_2, nullptr, &at_4});
  const auto other = run(flows, first, {nullptr, nullptr, &at_2b, nullptr, &at_4});
  EXPECT_EQ(fixed[1].landmarks.points[1].x_px, plain[1].landmarks.points[1].x_px);
  EXPECT_EQ(fixed[2].landmarks.points[1].x_px, 35);
  // By the same flows, to its own place on the first frame.
  EXPECT_NEAR(fixed[3].landmarks.points[1].x_px, 36, 1e-3);
  EXPECT_NEAR(fixed[2].home.points[1].x_px, 33, 2e-3);
  EXPECT_EQ(fixed[4].landmarks.points[1].x_px, 40);
  // What came before leaves no trace, and no other point changes.
  EXPECT_EQ(other[4].landmarks.points[1].y_px, fixed[4].landmarks.points[1].y_px);
  EXPECT_EQ(other[4].home.points[1].x_px, fixed[4].home.points[1].x_px);
  for (int t = 0; t < 5; ++t) EXPECT_EQ(fixed[t].landmarks.points[0].x_px, plain[t].landmarks.points[0].x_px);
}

TEST(ChainFlow, FollowsTheNamedPointsAlone) {
  ChainFlowOptions options;
  options.names = {"48"};
  const auto found = run({still(), shift(1, 0)}, {}, {}, options);
  ASSERT_EQ(found[1].landmarks.points.size(), 1u);
  EXPECT_EQ(found[1].landmarks.points[0].name, "48");
  EXPECT_NEAR(found[1].landmarks.points[0].x_px, 31.25, 1e-6);
  options.names = {"49"};
  EXPECT_THROW_TEXT(run({still()}, {}, {}, options),
                    "names has the point 49, which start does not have; it has 00, 48");
}

TEST(ChainFlow, PartsTheLipsOfAShutMouth) {
  // Inner lips in one place; above it all goes up, below it down.
  const Landmarks shut{{{"51", 30, 20, true}, {"62", 30, 25, true}, {"66", 30, 25, true}, {"57", 30, 31, true}}};
  const FlowField part = field([](double, double y) { return Vec2f{0, y < 25 ? -1.0f : y > 25 ? 3.0f : 0.0f}; });
  const auto at = [&](double lean_px) {
    ChainFlowOptions options;
    options.lean_px = lean_px;
    const ChainFlowResult first = chain_flow(still(), nullptr, shut, nullptr, {}, options);
    EXPECT_EQ(first.landmarks.points[1].y_px, 25);
    return chain_flow(part, nullptr, shut, nullptr,
                      engine::Prior<ChainFlowResult>(std::make_shared<const ChainFlowResult>(first)), options)
        .landmarks.points;
  };
  EXPECT_EQ(at(0)[1].y_px, 25);
  EXPECT_NEAR(at(2)[1].y_px, 24, 1e-6);
  EXPECT_NEAR(at(2)[2].y_px, 28, 1e-6);
  EXPECT_NEAR(at(2)[0].y_px, 19, 1e-6);
}

TEST(ChainFlow, APointOutsideTheFlowKeepsItsPlaceAndComesBack) {
  FlowField blind = still();
  blind.valid.assign(blind.valid.size(), 0);
  const auto found = run({still(), blind, shift(1, 0)}, {still(), blind, shift(2, 0)});
  EXPECT_FALSE(found[1].landmarks.points[0].valid);
  EXPECT_EQ(found[1].landmarks.points[0].x_px, 20);
  EXPECT_TRUE(found[2].landmarks.points[0].valid);
  EXPECT_NEAR(found[2].landmarks.points[0].x_px, 22, 1e-6);
}

TEST(ChainFlow, RejectsWhatDoesNotFit) {
  const Landmarks wrong{{{"77", 1, 2, true}}};
  EXPECT_THROW_TEXT(run({still()}, {}, {&wrong}),
                    "a correction names the point 77, which is not followed; these are 00, 48");
  FlowField small = still();
  small.displacement_px.pop_back();
  EXPECT_THROW_TEXT(run({small}, {}), "flow has 2999 displacements, expected 60 x 50");
  FlowField other{30, 100, std::vector<Vec2f>(3000), std::vector<std::uint8_t>(3000, 1)};
  EXPECT_THROW_TEXT(run({still()}, {other}), "from_first is 30 x 100 pixels, flow is 60 x 50");
}

// A pattern without edges at (x, y).
std::uint8_t pattern(double x, double y) {
  return static_cast<std::uint8_t>(std::lround(128 + 45 * std::sin(0.31 * x + 0.07 * y) +
                                               40 * std::sin(0.27 * y - 0.09 * x) +
                                               20 * std::sin(0.55 * x) * std::sin(0.6 * y)));
}
Image picture(double dx, double dy) {
  Image image{120, 100, 3, {}};
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 120; ++x) image.pixels.insert(image.pixels.end(), 3, pattern(x - dx, y - dy));
  return image;
}
engine::Window<Image> pair(const Image& before, const Image& now) {
  return {{std::make_shared<const Image>(before), std::make_shared<const Image>(now)}, 1};
}
Landmarks corners() { return {{{"a", 40, 35, true}, {"b", 80, 65, true}}}; }

TEST(FaceFlow, FindsTheMotionWithinTheBoxOfThePoints) {
  for (const bool half : {false, true}) {
    FaceFlowOptions options;
    options.half_size = half;
    options.margin = 0.1;
    const FlowField flow = face_flow(pair(picture(0, 0), picture(1.5, -2)), corners(), nullptr, options);
    const int scale = half ? 2 : 1;
    ASSERT_EQ(flow.width, 120 / scale);
    ASSERT_EQ(flow.height, 100 / scale);
    const auto middle = static_cast<std::size_t>(50 / scale * flow.width + 60 / scale);
    EXPECT_EQ(flow.valid[middle], 1);
    EXPECT_EQ(flow.valid[0], 0);
    EXPECT_NEAR(scale * flow.displacement_px[middle][0], 1.5, 0.1) << half;
    EXPECT_NEAR(scale * flow.displacement_px[middle][1], -2, 0.1) << half;
    // Kept to 1/64 px.
    EXPECT_EQ(64 * flow.displacement_px[middle][0], std::round(64 * flow.displacement_px[middle][0]));
  }
}

TEST(FaceFlow, IsNullOnTheFirstFrameUnlessItStartsFromAReference) {
  const engine::Window<Image> alone({std::make_shared<const Image>(picture(1, 0))}, 0);
  const FlowField none = face_flow(alone, corners(), nullptr);
  const auto middle = static_cast<std::size_t>(50 * 120 + 60);
  EXPECT_EQ(none.valid[middle], 1);
  EXPECT_EQ(none.displacement_px[middle][0], 0);
  const Image reference = picture(0, 0);
  EXPECT_NEAR(face_flow(alone, corners(), &reference).displacement_px[middle][0], 1, 0.1);
}

TEST(FaceFlow, WithoutPointsKnowsNothing) {
  const FlowField flow = face_flow(pair(picture(0, 0), picture(1, 0)), {}, nullptr);
  EXPECT_EQ(std::count(flow.valid.begin(), flow.valid.end(), 1), 0);
}

TEST(FaceFlow, RejectsAnotherSize) {
  Image small = picture(0, 0);
  small.height = 99;
  EXPECT_THROW_TEXT(face_flow(pair(picture(0, 0), small), corners(), nullptr),
                    "the frame has 36000 values, expected 120 x 99 pixels of 3 channels");
  small.pixels.resize(3 * 120 * 99);
  EXPECT_THROW_TEXT(face_flow(pair(picture(0, 0), small), corners(), nullptr),
                    "the previous frame is 120 x 100 pixels of 3 channels, the frame is 120 x 99 of 3");
}

}  // namespace
}  // namespace face::track
