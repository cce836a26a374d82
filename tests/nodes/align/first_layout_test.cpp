// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "nodes/align/find_markers.h"

namespace {

using namespace face;

Landmarks layout_of(int count, double x_px) {
  Landmarks layout;
  for (int i = 0; i < count; ++i) layout.points.push_back({"m" + std::to_string(i), x_px, 0, true});
  return layout;
}

TEST(FirstLayout, IsTheFirstOfThoseWithTheMostMarkers) {
  const engine::Seq<Landmarks> layouts({layout_of(2, 1), layout_of(5, 2), layout_of(5, 3), layout_of(4, 4)});
  const Landmarks first = align::first_layout(layouts);
  ASSERT_EQ(first.points.size(), 5u);
  EXPECT_EQ(first.points[0].x_px, 2);
}

}  // namespace
