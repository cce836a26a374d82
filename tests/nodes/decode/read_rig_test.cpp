// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "nodes/base/pose.h"
#include "nodes/decode/rig_shapes.h"
#include "nodes/types/arkit.h"
#include "tests/nodes/decode/temporary.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"
#include "tests/support/folder_file.h"

using namespace face;
using namespace face::decode;

namespace {

Rig read(const std::filesystem::path& folder) { return read_rig(test::folder_file(folder), nullptr); }

constexpr const char* square = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nf 1 2 3 4\n";
constexpr const char* moved = "v 0 -1 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\n";

// A folder with a neutral square and the six shapes that a rig needs.
void write_small_rig(const test::Temporary& temporary) {
  temporary.write("rig/generic_neutral_mesh.obj", square);
  for (const std::string_view name : needed_shapes) temporary.write("rig/" + std::string(name) + ".obj", moved);
}

}  // namespace

TEST(ReadRig, TakesAFolderWhoseNeutralMeshIsSimplyCalledNeutral) {
  const test::Temporary temporary;
  write_small_rig(temporary);
  std::filesystem::rename(temporary.path("rig/generic_neutral_mesh.obj"), temporary.path("rig/Neutral.obj"));
  EXPECT_EQ(read(temporary.path("rig")).neutral.points_mm.size(), 4u);
}

TEST(ReadRig, ReadsTheIctHeadInMillimetres) {
  DATA_FILE(folder, "ict-face/FaceXModel");
  const Rig rig = read(folder);
  EXPECT_EQ(rig.neutral.points_mm.size(), 26719u);
  EXPECT_EQ(rig.neutral.polygon_count(), 26384u);
  float low = 1e9f, high = -1e9f;
  for (const Vec3f& p : rig.neutral.points_mm) low = std::min(low, p[1]), high = std::max(high, p[1]);
  EXPECT_NEAR(high - low, 338.1f, 0.2f);  // head, neck and collar
  // From chin (landmark 8) to the top: a head.
  EXPECT_NEAR(high - rig.neutral.points_mm[rig.landmarks68[8]][1], 225, 25);
}

TEST(ReadRig, SortsTheIctShapesByArkitAndListsWhatIsMissing) {
  DATA_FILE(folder, "ict-face/FaceXModel");
  const Rig rig = read(folder);
  EXPECT_EQ(rig.missing, std::vector<std::string>{"tongueOut"});
  ASSERT_EQ(rig.shapes.size(), 56u);
  for (std::size_t s = 0; s < arkit_count; ++s) {
    EXPECT_EQ(rig.shapes[s].name, arkit_names[s]);
    EXPECT_EQ(rig.shapes[s].vertices.empty(), rig.shapes[s].name == "tongueOut") << rig.shapes[s].name;
    EXPECT_TRUE(std::is_sorted(rig.shapes[s].vertices.begin(), rig.shapes[s].vertices.end()));
    EXPECT_EQ(rig.shapes[s].vertices.size(), rig.shapes[s].offsets_mm.size());
  }
  std::set<std::string> extras;
  for (std::size_t s = arkit_count; s < rig.shapes.size(); ++s) extras.insert(rig.shapes[s].name);
  EXPECT_EQ(extras,
            (std::set<std::string>{"PupilDilateLeft", "PupilDilateRight", "cheekRaiserLeft", "cheekRaiserRight"}));
}

TEST(ReadRig, AddsUpTheHalvesOfIctShapesThatArkitHasWhole) {
  DATA_FILE(folder, "ict-face/FaceXModel");
  const Rig rig = read(folder);
  for (const char* name : {"browInnerUp", "cheekPuff"}) {
    float left = 0, right = 0;
    const Shape& shape = rig.shapes[arkit_index(name)];
    for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
      const float size =
          std::abs(shape.offsets_mm[i][0]) + std::abs(shape.offsets_mm[i][1]) + std::abs(shape.offsets_mm[i][2]);
      (rig.neutral.points_mm[shape.vertices[i]][0] > 0 ? left : right) += size;
    }
    EXPECT_GT(left, 100);
    EXPECT_NEAR(left / right, 1, 0.1) << name;
  }
}

TEST(ReadRig, MarksTheIctMouth) {
  DATA_FILE(folder, "ict-face/FaceXModel");
  const Rig rig = read(folder);
  ASSERT_EQ(rig.inner_lips.size(), 3u);
  EXPECT_EQ(rig.inner_lips[1].upper, 5533u);
  EXPECT_EQ(rig.inner_lips[1].lower, 5517u);
  EXPECT_EQ(rig.landmarks68.size(), 68u);
  EXPECT_GT(rig.lower_lip.size(), 40u);
  EXPECT_GT(rig.upper_teeth.size(), 80u);
  for (const std::uint32_t v : rig.upper_teeth) {
    EXPECT_GE(v, 17039u);  // teeth
    EXPECT_LE(v, 19246u);  // upper ones
  }
  const Shape& jaw_open = rig.shapes[arkit_index("jawOpen")];
  for (const std::uint32_t v : rig.lower_lip) {
    EXPECT_LE(v, 13293u);  // face or mouth socket
    const auto at = std::lower_bound(jaw_open.vertices.begin(), jaw_open.vertices.end(), v);
    ASSERT_TRUE(at != jaw_open.vertices.end() && *at == v);
    EXPECT_LT(jaw_open.offsets_mm[static_cast<std::size_t>(at - jaw_open.vertices.begin())][1], -10);
  }
}

TEST(ReadRig, DressesTheIctHead) {
  DATA_FILE(folder, "ict-face/FaceXModel");
  const Rig rig = read(folder);
  std::uint32_t next = 0;
  std::set<std::string> visible, hidden;
  for (const Part& part : rig.neutral.parts) {
    EXPECT_EQ(part.first_polygon, next) << part.name;
    next += part.polygon_count;
    (part.visible ? visible : hidden).insert(part.name);
  }
  EXPECT_EQ(next, rig.neutral.polygon_count());
  EXPECT_EQ(visible, (std::set<std::string>{"face", "head", "mouth_socket", "eye_sockets", "gums_tongue", "teeth",
                                            "sclera_left", "sclera_right", "lashes"}));
  EXPECT_EQ(hidden, (std::set<std::string>{"iris_left", "iris_right", "eye_fluid", "eye_blend", "eye_occlusion",
                                           "lash_cards"}));
  ASSERT_EQ(rig.neutral.colors_srgb.size(), 26719u);
  // Lips are redder than cheeks; an eye has a pupil and a white.
  EXPECT_LT(rig.neutral.colors_srgb[rig.landmarks68[57]][1], 0.9f);
  EXPECT_EQ(rig.neutral.colors_srgb[rig.landmarks68[3]], (Vec3f{1, 1, 1}));
  float dark = 1, bright = 0;
  for (std::uint32_t v = 21451; v <= 22220; ++v) {
    dark = std::min(dark, rig.neutral.colors_srgb[v][0]);
    bright = std::max(bright, rig.neutral.colors_srgb[v][0]);
  }
  EXPECT_LT(dark, 0.1f);
  EXPECT_GT(bright, 0.9f);
  // The nostrils are dark inside, the tip of the nose is not.
  const Vec3f& below_nose = rig.neutral.points_mm[rig.landmarks68[33]];
  int nostril_vertices[2] = {0, 0};  // right, left
  for (std::uint32_t v = 0; v <= 9408; ++v) {
    const Vec3f& p = rig.neutral.points_mm[v];
    if (std::abs(p[1] - below_nose[1]) < 15 && std::abs(p[0]) < 15 && std::abs(p[2] - below_nose[2]) < 15)
      nostril_vertices[p[0] > 0] += rig.neutral.colors_srgb[v][0] < 0.5f;
  }
  EXPECT_GT(nostril_vertices[0], 10);
  EXPECT_GT(nostril_vertices[1], 10);
  EXPECT_EQ(rig.neutral.colors_srgb[rig.landmarks68[30]], (Vec3f{1, 1, 1}));
}

TEST(ReadRig, TakesTheUnitThatItIsTold) {
  const test::Temporary temporary;
  write_small_rig(temporary);
  const engine::File file = test::folder_file(temporary.folder() / "rig");
  EXPECT_EQ(read_rig(file, nullptr).neutral.points_mm[2][0], 100);  // 10 units are taken for cm
  EXPECT_EQ(read_rig(file, nullptr, {LengthUnit::mm}).neutral.points_mm[2][0], 10);
  EXPECT_EQ(read_rig(file, nullptr, {LengthUnit::m}).neutral.points_mm[2][0], 10000);
  EXPECT_EQ(read_rig(file, nullptr, {LengthUnit::mm}).shapes[arkit_index("jawOpen")].offsets_mm[0], (Vec3f{0, -1, 0}));
}

TEST(ReadRig, ListsTheShapesThatASmallRigLacks) {
  const test::Temporary temporary;
  write_small_rig(temporary);
  const Rig rig = read(temporary.folder() / "rig");
  EXPECT_EQ(rig.missing.size(), 46u);
  EXPECT_EQ(rig.shapes.size(), 52u);
}

TEST(ReadRig, RefusesARigWithoutTheShapesThatSpeechNeeds) {
  const test::Temporary temporary;
  write_small_rig(temporary);
  std::filesystem::remove(temporary.path("rig/mouthClose.obj"));
  std::filesystem::remove(temporary.path("rig/mouthRollLower.obj"));
  EXPECT_THROW_TEXT(
      read(temporary.folder() / "rig"),
      "rig: lacks the shapes mouthClose, mouthRollLower; a rig needs jawOpen, mouthClose, mouthFunnel, mouthPucker, "
      "mouthRollLower, mouthRollUpper. Found jawOpen, mouthFunnel, mouthPucker, mouthRollUpper");
}

TEST(ReadRig, RefusesAShapeOfAnotherVertexCount) {
  const test::Temporary temporary;
  write_small_rig(temporary);
  temporary.write("rig/jawOpen.obj", "v 0 0 0\nv 1 0 0\n");
  EXPECT_THROW_TEXT(read(temporary.folder() / "rig"),
                    "jawOpen.obj: has 2 vertices, the neutral mesh generic_neutral_mesh.obj has 4");
}

TEST(ReadRig, SaysWhatItLookedForInAFolderThatIsNoRig) {
  const test::Temporary temporary;
  temporary.write("clips/a.txt", "a");
  temporary.write("clips/b.txt", "b");
  EXPECT_THROW_TEXT(
      read(temporary.folder() / "clips"),
      "clips: is not a rig: found 2 files, of which 0 are GLB or glTF; expected an ICT-FaceKit folder "
      "(generic_neutral_mesh.obj or neutral.obj, and one OBJ file per shape) or one glTF file with its buffers");
}

TEST(ReadRig, MapsNamesByAFile) {
  const test::Temporary temporary;
  write_small_rig(temporary);
  std::filesystem::rename(temporary.path("rig/jawOpen.obj"), temporary.path("rig/Kiefer_auf.obj"));
  const engine::File file = test::folder_file(temporary.folder() / "rig");
  const engine::File names = engine::File::at(temporary.write("names.json", R"({"Kiefer_auf": "jawOpen"})"));
  EXPECT_FALSE(read_rig(file, &names).shapes[arkit_index("jawOpen")].vertices.empty());
  const engine::File wrong = engine::File::at(temporary.write("names.json", R"({"Kiefer_auf": "jawsOpen"})"));
  EXPECT_THROW_TEXT(read_rig(file, &wrong),
                    "names.json at /Kiefer_auf: found \"jawsOpen\", expected one of ARKit's 52 names (jawOpen, ...)");
  const engine::File absent = engine::File::at(temporary.write("names.json", R"({"Kinn": "jawOpen"})"));
  EXPECT_THROW_TEXT(
      read_rig(file, &absent),
      "names.json at /Kinn: rig has no such shape. Found Kiefer_auf, mouthClose, mouthFunnel, mouthPucker, "
      "mouthRollLower, mouthRollUpper");
}

TEST(RigShapes, SpellsNamesAsArkitDoes) {
  EXPECT_EQ(arkit_spelling("jawOpen"), "jawOpen");
  EXPECT_EQ(arkit_spelling("JAWOPEN"), "jawOpen");
  EXPECT_EQ(arkit_spelling("jaw_open"), "jawOpen");
  EXPECT_EQ(arkit_spelling("eyeBlink_L"), "eyeBlinkLeft");
  EXPECT_EQ(arkit_spelling("eyeblink_right"), "eyeBlinkRight");
  EXPECT_EQ(arkit_spelling("head_blendShapes.mouthSmile_R"), "mouthSmileRight");
  EXPECT_EQ(arkit_spelling("browInnerUp_L"), "browInnerUp");
  EXPECT_EQ(arkit_spelling("cheekPuffRight"), "cheekPuff");
  EXPECT_EQ(arkit_spelling("mouthLeft"), "mouthLeft");
  EXPECT_EQ(arkit_spelling("jawRight"), "jawRight");
  EXPECT_EQ(arkit_spelling("cheekRaiser_L"), "cheekRaiserLeft");
  EXPECT_EQ(arkit_spelling("viseme_PP"), "viseme_PP");
  EXPECT_EQ(arkit_spelling("blendShape1.jawOpen"), "jawOpen");
  EXPECT_EQ(arkit_spelling("Head|blendShape1.mouthSmile_L"), "mouthSmileLeft");
  EXPECT_EQ(arkit_spelling("Face:JawOpen"), "jawOpen");
  EXPECT_EQ(arkit_spelling("mouthSmile.L"), "mouthSmileLeft");  // Blender's sides
  EXPECT_EQ(arkit_spelling("Head.mouthSmile.R"), "mouthSmileRight");
  EXPECT_EQ(arkit_spelling("eye-blink-l"), "eyeBlinkLeft");
  EXPECT_EQ(arkit_spelling("Head.cheekRaiser.L"), "cheekRaiserLeft");
  EXPECT_EQ(arkit_spelling("jawOpen.001"), "jawOpen.001");  // a copy: added up it would open the jaw twice
  EXPECT_EQ(arkit_spelling("Head."), "Head.");
  EXPECT_EQ(arkit_spelling(""), "");
}
