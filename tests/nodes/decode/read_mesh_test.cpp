// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "tests/nodes/decode/temporary.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::decode;

namespace {

template <class T>
void put(std::string& out, T value, bool big_endian = false) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (big_endian) std::reverse(raw, raw + sizeof value);
  out.append(raw, sizeof value);
}

ReadMeshResult read(const std::string& name, const std::string& bytes, LengthUnit unit = LengthUnit::mm) {
  const test::Temporary temporary;
  return read_mesh(engine::File::at(temporary.write(name, bytes)), {unit});
}

// As trimesh and psbody.mesh write FLAME's registrations: float x, y, z and lists of int, binary.
std::string binary_ply(bool big_endian) {
  std::string out = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                    "_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face "
                    "2\nproperty list uchar int vertex_indices\nend_header\n";
  for (const float x : {0.0f, 0.0f, 0.0f, 0.1f, 0.0f, 0.0f, 0.0f, 0.2f, 0.0f, 0.1f, 0.2f, -0.05f})
    put(out, x, big_endian);
  for (const auto& triangle : {std::array<std::int32_t, 3>{0, 1, 2}, {2, 1, 3}}) {
    out += '\3';
    for (const std::int32_t v : triangle) put(out, v, big_endian);
  }
  return out;
}

}  // namespace

TEST(ReadMesh, ReadsBinaryPlyOfEitherByteOrderInMetres) {
  for (const bool big : {false, true}) {
    const auto result = read("frame.ply", binary_ply(big), LengthUnit::automatic);
    ASSERT_EQ(result.mesh.points_mm.size(), 4u);
    EXPECT_NEAR(result.mesh.points_mm[3][1], 200, 1e-4);
    EXPECT_NEAR(result.mesh.points_mm[3][2], -50, 1e-4);
    EXPECT_EQ(result.mesh.corners, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3}));
    EXPECT_EQ(result.mesh.polygon_starts, (std::vector<std::uint32_t>{0, 3, 6}));
    EXPECT_EQ(result.points.points_mm, result.mesh.points_mm);
  }
}

TEST(ReadMesh, ReadsWrittenPlyWithColoursAndSkipsTheRest) {
  const auto result =
      read("scan.ply",
           "ply\r\nformat ascii 1.0\r\ncomment a scan\r\nelement vertex 3\r\nproperty double x\r\n"
           "property double y\r\nproperty double z\r\nproperty float nx\r\nproperty uchar red\r\n"
           "property uchar green\r\nproperty uchar blue\r\nproperty list uchar int more\r\nelement face 1\r\n"
           "property uchar flags\r\nproperty list uchar uint vertex_index\r\nelement edge 1\r\n"
           "property int a\r\nend_header\r\n0 0 0 1 255 0 51 2 7 7\r\n1.5 0 0 1 0 0 0 0\r\n"
           "0 -2e1 0 1 0 0 0 0\r\n9 3 0 1 2\r\n5\r\n");
  EXPECT_EQ(result.mesh.points_mm[1][0], 1.5f);
  EXPECT_EQ(result.mesh.points_mm[2][1], -20);
  ASSERT_EQ(result.mesh.colors_srgb.size(), 3u);
  EXPECT_EQ(result.mesh.colors_srgb[0], (Vec3f{1, 0, 0.2f}));
  EXPECT_EQ(result.mesh.corners, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(ReadMesh, ReadsPointsWithoutPolygons) {
  const auto result =
      read("p.ply",
           "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
           "end_header\n1 2 3\n");
  EXPECT_EQ(result.mesh.polygon_count(), 0u);
  EXPECT_EQ(result.mesh.points_mm[0], (Vec3f{1, 2, 3}));
}

TEST(ReadMesh, MakesAPartOfEveryMaterialOfAnObj) {
  const auto result =
      read("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl skin\nf 3 2 1\nf 1 3 2\nusemtl teeth\nf 1 2 3\n",
           LengthUnit::cm);
  EXPECT_EQ(result.mesh.points_mm[1][0], 10);
  ASSERT_EQ(result.mesh.parts.size(), 3u);
  EXPECT_EQ(result.mesh.parts[1].name, "skin");
  EXPECT_EQ(result.mesh.parts[1].first_polygon, 1u);
  EXPECT_EQ(result.mesh.parts[1].polygon_count, 2u);
  EXPECT_EQ(result.mesh.parts[2].name, "teeth");
}

TEST(ReadMesh, KeepsTheVertexOrderOfTheIctHead) {
  DATA_FILE(path, "ict-face/FaceXModel/generic_neutral_mesh.obj");
  const auto result = read_mesh(engine::File::at(path));
  EXPECT_EQ(result.mesh.points_mm.size(), 26719u);
  EXPECT_EQ(result.mesh.polygon_count(), 26384u);
}

TEST(ReadMesh, SaysWhatIsWrongWithAFile) {
  EXPECT_THROW_TEXT(read("a.ply", ""), "a.ply: is empty (0 bytes), expected PLY or OBJ");
  EXPECT_THROW_TEXT(read("a.ply", "ply\n"), "a.ply:2: found the end of the file, expected end_header");
  EXPECT_THROW_TEXT(read("a.ply", "hello"), "a.ply: found \"hello\", expected \"ply\"");
  EXPECT_THROW_TEXT(read("a.ply", "ply\nformat text 1.0\n"),
                    "a.ply:2: found \"format text 1.0\", expected ascii, binary_little_endian or binary_big_endian");
  EXPECT_THROW_TEXT(read("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n"),
                    "a.ply:4: found \"property half x\", expected a type of number (char to double)");
  EXPECT_THROW_TEXT(read("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"),
                    "a.ply: its vertices have no x, y and z");
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  EXPECT_THROW_TEXT(read("a.ply", head + "1 2 three\n"), "a.ply:10: found \"three\", expected a number");
  EXPECT_THROW_TEXT(read("a.ply", head + "1 2 nan\n"), "a.ply: vertex 0 is at (1, 2, nan), expected finite numbers");
  EXPECT_THROW_TEXT(read("a.ply", head + "1 2 3\n3 0 1 2\n"),
                    "a.ply: a polygon has vertex 1, but there are 1 vertices");
  EXPECT_THROW_TEXT(read("a.ply", head + "1 2 3\n2 0 0\n"), "a.ply: face 0 has 2 corners, expected 3 or more");
  EXPECT_THROW_TEXT(read("a.ply", head + "1 2 3\n-1\n"), "a.ply: found a list of -1 numbers, expected 0 to a million");
  EXPECT_THROW_TEXT(read("a.ply", binary_ply(false).substr(0, 200)),
                    "a.ply: is cut off at byte 200, expected more numbers");
}

TEST(ReadMesh, NamesWhatWouldServeForOtherFiles) {
  EXPECT_THROW_TEXT(read("a.fbx", "x"),
                    "a.fbx: found the suffix \".fbx\", expected PLY or OBJ; open it in Blender and export PLY or OBJ");
  EXPECT_THROW_TEXT(read("a.glb", "x"),
                    "a.glb: found the suffix \".glb\", expected PLY or OBJ; decode.rig reads heads with morph targets, "
                    "decode.rig_mesh their mesh");
  EXPECT_THROW_TEXT(
      read("raw_audio_fixed.pkl", "x"),
      "raw_audio_fixed.pkl: found the suffix \".pkl\", expected PLY or OBJ; Python's pickles are programs "
      "and are not opened: save the vertices with numpy.save and use decode.points");
}

TEST(RigMesh, IsTheHeadAtRest) {
  Rig rig;
  rig.neutral.points_mm = {{1, 2, 3}};
  EXPECT_EQ(rig_mesh(rig).points_mm, rig.neutral.points_mm);
}
