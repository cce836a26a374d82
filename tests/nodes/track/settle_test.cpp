// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/settle.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::track;

namespace {

// Five points on a horizontal line, 6 px apart.
Landmarks line() {
  Landmarks out;
  for (int i = 0; i < 5; ++i) out.points.push_back({"p" + std::to_string(i), 100.0 + 6 * i, 50, true});
  return out;
}

}  // namespace

TEST(Settle, LeavesPointsThatMovedTogetherWhereTheyWereSeen) {
  std::vector<Sighting> seen;
  for (const Landmark& p : line().points) seen.push_back({p.x_px + 4, p.y_px - 3, 10, 0, 10});
  const auto settled = settle(line(), seen, {1});
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(settled[i].x_px, seen[i].x_px, 1e-9);
    EXPECT_NEAR(settled[i].y_px, seen[i].y_px, 1e-9);
  }
}

TEST(Settle, PutsAPointThatWasNotSeenWhereItsNeighboursSay) {
  std::vector<Sighting> seen;
  for (const Landmark& p : line().points) seen.push_back({p.x_px + 4, p.y_px - 3, 10, 0, 10});
  seen[2] = {};
  const auto settled = settle(line(), seen, {1});
  EXPECT_NEAR(settled[2].x_px, 116, 1e-6);
  EXPECT_NEAR(settled[2].y_px, 47, 1e-6);
}

TEST(Settle, BringsBackAPointThatSlidAlongItsContour) {
  std::vector<Sighting> seen;
  for (const Landmark& p : line().points) seen.push_back({p.x_px, p.y_px, 0.02, 0, 600});  // well across, badly along
  seen[2].x_px += 4;
  seen[2].y_px += 1;
  const auto settled = settle(line(), seen, {1});
  EXPECT_LT(std::abs(settled[2].x_px - 112), 0.9);
  EXPECT_NEAR(settled[2].y_px, 51, 0.02);
}

TEST(Settle, RejectsUnequalCounts) {
  EXPECT_THROW_TEXT(settle(line(), std::vector<Sighting>(3), {1}), "sightings has 3 points, start has 5");
}
