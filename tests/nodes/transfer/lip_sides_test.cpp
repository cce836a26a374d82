// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/lip_sides.h"

#include <gtest/gtest.h>

#include "tests/support/lip_sheet.h"

namespace face::transfer {

// Vertices of a coarse mesh lie beside each other along the lips, with none of the other lip below or above.
TEST(LipSides, AreToldOfLipsWhoseVerticesLieBesideEachOther) {
  Mesh mesh = test::lip_sheet(4);
  const std::uint32_t columns = test::sheet_columns, upper_row = test::sheet_upper_lip;
  for (std::uint32_t v = 0; v < mesh.points_mm.size(); ++v)
    if (v / columns <= upper_row) mesh.points_mm[v][0] += 1;
  const MouthOpening mouth = find_mouth_opening(mesh);
  EXPECT_EQ(mouth.upper.size(), 18u);
  EXPECT_EQ(mouth.lower.size(), 18u);
  for (const std::uint32_t v : mouth.upper) EXPECT_EQ(v / columns, upper_row) << v;
  for (const std::uint32_t v : mouth.lower) EXPECT_EQ(v / columns, upper_row + 1) << v;
}

}  // namespace face::transfer
