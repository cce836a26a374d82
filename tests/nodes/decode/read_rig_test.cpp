// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "nodes/types/arkit.h"
#include "tests/nodes/decode/rig_folder.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::decode;

namespace {

Rig ict(const std::string& folder) { return read_rig(test::folder_file(folder), nullptr); }

}  // namespace

TEST(ReadRig, ReadsTheIctHeadInMillimetres) {
  DATA_FILE(folder, "ict-face/FaceXModel");
  const Rig rig = ict(folder);
  EXPECT_EQ(rig.neutral.points_mm.size(), 26719u);
  EXPECT_EQ(rig.neutral.polygon_count(), 26384u);
  float low = 1e9f, high = -1e9f;
  for (const Vec3f& p : rig.neutral.points_mm) low = std::min(low, p[1]), high = std::max(high, p[1]);
  EXPECT_NEAR(high - low, 338.1f, 0.2f);  // head, neck and collar
}
