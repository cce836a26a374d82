// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/mesh_lip_gap.h"

#include <gtest/gtest.h>

#include "nodes/types/table.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::evaluate;

// An upper and a lower lip of one vertex each, so far apart.
MeshPoints mouth(float gap_mm) { return {{{0, gap_mm, 0}, {0, 0, 0}}}; }

Rig lips() {
  Rig rig;
  rig.neutral.points_mm = mouth(3).points_mm;  // not closed itself
  rig.inner_lips = {{0, 1}};
  return rig;
}

const Phones phones{{{"SIL", 0, 0.1, "", 0}, {"M", 0.1, 0.3, "m", 0}, {"AA", 0.3, 0.5, "m", 0}}, 0.5, true};
const Timeline timeline{{0, 0.1, 0.2, 0.3, 0.4, 0.5}, 0.6};

}  // namespace

TEST(MeshLipGap, CountsFromTheMouthThatIsTrulyClosed) {
  const engine::Seq<MeshPoints> own({mouth(3), mouth(3), mouth(2.6f), mouth(4), mouth(9), mouth(3)});
  const engine::Seq<MeshPoints> truth({mouth(1), mouth(1), mouth(1), mouth(4), mouth(8), mouth(1)});
  const LipGapResult result = mesh_lip_gap(lips(), own, &truth, mouth(1), phones, timeline);
  ASSERT_EQ(result.table.columns[1], "closure_percent");
  EXPECT_EQ(result.table.rows[0].values[1], 0);  // 1.6 mm at its best
  EXPECT_NEAR(result.table.rows[0].values[2], 0.6, 1e-5);
  EXPECT_EQ(result.table.rows[1].values[1], 100);
  EXPECT_NEAR(result.frames.rows[4].values[0], 8, 1e-5);
  EXPECT_NEAR(result.frames.rows[4].values[1], 7, 1e-5);
  // From its own neutral the same mouth would seem to close.
  EXPECT_EQ(mesh_lip_gap(lips(), own, nullptr, mouth(3), phones, timeline).table.rows[0].values[1], 100);
}

TEST(MeshLipGap, RejectsVerticesThatAreNotTheRigs) {
  const engine::Seq<MeshPoints> own(std::vector<MeshPoints>(6, mouth(1)));
  EXPECT_THROW_TEXT(mesh_lip_gap(lips(), own, nullptr, {{{0, 0, 0}}}, phones, timeline),
                    "closed has 1 vertices, the rig 2");
  const engine::Seq<MeshPoints> less(std::vector<MeshPoints>(6, MeshPoints{{{0, 0, 0}}}));
  EXPECT_THROW_TEXT(mesh_lip_gap(lips(), less, nullptr, mouth(0), phones, timeline),
                    "points 0 has 1 vertices, the rig's lips vertex 1");
}
