// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/obj.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

using namespace face::decode;

TEST(Obj, ReadsVerticesUvsPolygonsAndMaterials) {
  const Obj obj = read_obj(
      "# a quad and a triangle\r\nv 0 0 0\r\nv 1 0 0\nv 1 1 0 \nv 0 1e0 -0.5\nvt 0 0\nvt 1 1\nvn 0 0 1\n"
      "usemtl M_Face\nf 1/1/1 2/2/1 3/1/1 4/2/1\nusemtl M_Teeth\nf -4/1 -3/1 -1/2\n",
      "a.obj");
  ASSERT_EQ(obj.points.size(), 4u);
  EXPECT_EQ(obj.points[3][2], -0.5f);
  EXPECT_EQ(obj.corners, (std::vector<std::uint32_t>{0, 1, 2, 3, 0, 1, 3}));
  EXPECT_EQ(obj.polygon_starts, (std::vector<std::uint32_t>{0, 4, 7}));
  EXPECT_EQ(obj.corner_uvs, (std::vector<std::uint32_t>{0, 1, 0, 1, 0, 0, 1}));
  ASSERT_EQ(obj.materials.size(), 2u);
  EXPECT_EQ(obj.materials[1].name, "M_Teeth");
  EXPECT_EQ(obj.materials[1].first_polygon, 1u);
}

TEST(Obj, ReadsPolygonsWithoutTextureCoordinates) {
  const Obj obj = read_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nf 1//1 2//1 3//1", "a.obj");
  EXPECT_EQ(obj.corners.size(), 3u);
  EXPECT_TRUE(obj.corner_uvs.empty());
}

TEST(Obj, NamesTheLineOfWhatIsWrong) {
  EXPECT_THROW_TEXT(read_obj("v 0 0 0\nv 1 zero 0\n", "a.obj"),
                    "a.obj line 2: found \"zero 0\", expected a finite number");
  EXPECT_THROW_TEXT(read_obj("v 0 0\n", "a.obj"), "a.obj line 1: found \"\", expected a finite number");
  EXPECT_THROW_TEXT(read_obj("v 0 0 nan\n", "a.obj"), "a.obj line 1: found \"nan\", expected a finite number");
  EXPECT_THROW_TEXT(read_obj("v 0 0 0\nv 0 0 1\nv 0 1 0\nf 1 2 4\n", "a.obj"),
                    "a.obj line 4: found vertex 4, expected one of 1 to 3");
  EXPECT_THROW_TEXT(read_obj("v 0 0 0\nv 0 0 1\nf 1 2\n", "a.obj"),
                    "a.obj line 3: found a polygon of 2 corners, expected 3 or more");
  EXPECT_THROW_TEXT(read_obj("v 0 0 0\nf one 1 1\n", "a.obj"),
                    "a.obj line 2: found \"one 1 1\", expected the index of a vertex");
}
