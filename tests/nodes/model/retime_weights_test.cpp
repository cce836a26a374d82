// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/retime_weights.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::model;

namespace {

std::vector<float> retimed(const Timeline& clip, const RetimeWeightsOptions& options = {}) {
  std::vector<float> result;
  engine::SeqWriter<Weights> writer([&](const std::string&, Weights w) { result.push_back(w.values.at(0)); });
  retime_weights(engine::Seq<Weights>(std::vector<Weights>{{{0.0f}}, {{1.0f}}, {{0.5f}}}), {{0.0, 0.1, 0.2}, 0.3}, clip,
                 writer, options);
  return result;
}

TEST(RetimeWeights, IsLinearBetweenMomentsAndHeldBeyond) {
  const std::vector<float> found = retimed({{-1.0, 0.0, 0.05, 0.15, 0.2, 9.0}, 10});
  const std::vector<float> expected = {0.0f, 0.0f, 0.5f, 0.75f, 0.5f, 0.5f};
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-6) << i;
}

TEST(RetimeWeights, MovesTheWeightsLaterByTheDelay) {
  EXPECT_NEAR(retimed({{0.15}, 1}, {.delay_s = 0.1})[0], 0.5, 1e-6);
}

TEST(RetimeWeights, RejectsATimelineOfAnotherLength) {
  engine::SeqWriter<Weights> writer([](const std::string&, Weights) {});
  EXPECT_THROW_TEXT(retime_weights(engine::Seq<Weights>(std::vector<Weights>{{{0.0f}}}), {{0, 1}, 2}, {{0}, 1}, writer),
                    "there are 1 weights, but their timeline has 2 moments");
}

}  // namespace
