// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_identity_modes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/decode/read_rig.h"
#include "tests/support/folder_file.h"
#include "tests/nodes/decode/temporary.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::decode;

namespace {

constexpr const char* square = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nf 1 2 3 4\n";

ShapeSet read(const std::filesystem::path& folder, LengthUnit unit = LengthUnit::automatic) {
  ReadIdentityModesOptions options;
  options.unit = unit;
  return read_identity_modes(test::folder_file(folder), options);
}

}  // namespace

TEST(ReadIdentityModes, ReadsTheFortyOfTheIctHead) {
  DATA_FILE(folder, "ict-face/FaceXModel");
  const ShapeSet modes = read(folder);
  ASSERT_EQ(modes.shapes.size(), 40u);
  EXPECT_EQ(modes.shapes[0].name, "identity000");
  EXPECT_EQ(modes.shapes[39].name, "identity039");
  const std::size_t vertices = 26719;  // of the rig that decode.rig reads there
  double first = 0, last = 0;
  for (const Shape& mode : modes.shapes) {
    ASSERT_EQ(mode.vertices.size(), mode.offsets_mm.size());
    EXPECT_LT(mode.vertices.back(), vertices);
  }
  for (const Vec3f& o : modes.shapes[0].offsets_mm) first += o[0] * o[0] + o[1] * o[1] + o[2] * o[2];
  for (const Vec3f& o : modes.shapes[39].offsets_mm) last += o[0] * o[0] + o[1] * o[1] + o[2] * o[2];
  // Millimetres: the first mode moves the head by 3.75 mm in the mean, the last by 0.18.
  EXPECT_NEAR(std::sqrt(first / vertices), 3.75, 0.01);
  EXPECT_NEAR(std::sqrt(last / vertices), 0.18, 0.01);
}

TEST(ReadIdentityModes, GivesOffsetsOfTheVerticesThatMove) {
  const test::Temporary temporary;
  temporary.write("rig/generic_neutral_mesh.obj", square);
  temporary.write("rig/identity007.obj", "v 0 0 0\nv 10 1 2\nv 10 10 0\nv 0 10 -3\n");
  temporary.write("rig/identity002.obj", "v 0 0 1\nv 10 0 0\nv 10 10 0\nv 0 10 0\n");
  const ShapeSet modes = read(temporary.path("rig"), LengthUnit::cm);
  ASSERT_EQ(modes.shapes.size(), 2u);
  EXPECT_EQ(modes.shapes[0].name, "identity002");
  EXPECT_EQ(modes.shapes[1].vertices, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_EQ(modes.shapes[1].offsets_mm, (std::vector<Vec3f>{{0, 10, 20}, {0, 0, -30}}));
}

TEST(ReadIdentityModes, RejectsAFolderWithoutAnyAndOtherMeshes) {
  const test::Temporary temporary;
  temporary.write("rig/generic_neutral_mesh.obj", square);
  EXPECT_THROW_TEXT(read(temporary.path("rig")), "rig: holds no identityNNN.obj beside generic_neutral_mesh.obj");
  temporary.write("rig/identity000.obj", "v 0 0 0\nv 10 0 0\n");
  EXPECT_THROW_TEXT(read(temporary.path("rig")),
                    "identity000.obj: has 2 vertices, the neutral mesh generic_neutral_mesh.obj has 4");
  temporary.write("empty/note.txt", "nothing");
  EXPECT_THROW_TEXT(read(temporary.path("empty")), "empty: holds no generic_neutral_mesh.obj");
}
