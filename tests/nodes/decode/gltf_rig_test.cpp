// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "nodes/decode/read_rig.h"
#include "nodes/types/arkit.h"
#include "tests/nodes/decode/rig_folder.h"
#include "tests/nodes/decode/temporary.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::decode;

namespace {

std::string base64(const std::string& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return out;
}

template <class T>
std::string bytes_of_values(const std::vector<T>& values) {
  std::string out(values.size() * sizeof(T), '\0');
  std::memcpy(out.data(), values.data(), out.size());
  return out;
}

const char* six_names = R"("jawOpen","mouthClose","MouthFunnel","mouth_pucker","mouthRollLower","mouthRollUpper")";

// A square of two triangles with its own copy of vertex 0, in metres; every target moves vertex 0 and its copy 10 mm
// down, by a sparse accessor. The node is 1 m up and twice as large.
std::string square_gltf(const std::string& names, const std::string& extras = "") {
  const std::string data =
      bytes_of_values<float>({0, 0, 0, 0.1f, 0, 0, 0.1f, 0.1f, 0, 0, 0.1f, 0, 0, 0, 0}) +  // 0: positions
      bytes_of_values<float>({0, -0.01f, 0, 0, -0.01f, 0}) +                               // 60: offsets
      bytes_of_values<std::uint16_t>({0, 1, 2, 4, 2, 3}) +                                 // 84: indices
      bytes_of_values<std::uint16_t>({0, 4});                                              // 96: moved
  const std::string targets =
      R"({"POSITION":1},{"POSITION":1},{"POSITION":1},{"POSITION":1},{"POSITION":1},{"POSITION":1})";
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"translation":[0,1,0],"scale":[2,2,2]}],
    "meshes":[{"name":"Head","primitives":[{"attributes":{"POSITION":0},"indices":2,"material":0,"targets":[)" +
         targets + R"(]}],"extras":{"targetNames":[)" + names + "]" + extras + R"(}}],
    "materials":[{"name":"Skin","pbrMetallicRoughness":{"baseColorFactor":[1,0.2140411,0,1],"roughnessFactor":0.475}}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3","min":[0,0,0],"max":[0.1,0.1,0]},
      {"componentType":5126,"count":5,"type":"VEC3","sparse":{"count":2,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":1}}},
      {"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteLength":60},{"buffer":0,"byteOffset":60,"byteLength":24},
      {"buffer":0,"byteOffset":84,"byteLength":12},{"buffer":0,"byteOffset":96,"byteLength":4}],
    "buffers":[{"byteLength":)" +
         std::to_string(data.size()) + R"(,"uri":"data:application/octet-stream;base64,)" + base64(data) + "\"}]}";
}

Rig read(const std::string& text, const std::string& name = "head.gltf") {
  const test::Temporary temporary;
  return read_rig(engine::File::at(temporary.write(name, text)), nullptr);
}

}  // namespace

TEST(GltfRig, MergesSeamsAndReadsSparseShapesInMillimetres) {
  const Rig rig = read(square_gltf(six_names));
  ASSERT_EQ(rig.neutral.points_mm.size(), 4u);
  EXPECT_EQ(rig.neutral.polygon_count(), 2u);
  EXPECT_EQ(rig.neutral.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_NEAR(rig.neutral.points_mm[2][0], 200, 1e-3);
  EXPECT_NEAR(rig.neutral.points_mm[2][1], 1200, 1e-3);
  const Shape& jaw_open = rig.shapes[arkit_index("jawOpen")];
  EXPECT_EQ(jaw_open.vertices, std::vector<std::uint32_t>{0});
  EXPECT_NEAR(jaw_open.offsets_mm[0][1], -20, 1e-3);
  EXPECT_FALSE(rig.shapes[arkit_index("mouthPucker")].vertices.empty());
  EXPECT_EQ(rig.missing.size(), 46u);
}

TEST(GltfRig, TakesColourAndGlossFromTheMaterial) {
  const Rig rig = read(square_gltf(six_names));
  ASSERT_EQ(rig.neutral.parts.size(), 1u);
  EXPECT_EQ(rig.neutral.parts[0].name, "skin");
  EXPECT_NEAR(rig.neutral.parts[0].albedo_srgb[0], 1, 1e-3);
  EXPECT_NEAR(rig.neutral.parts[0].albedo_srgb[1], 0.5, 1e-3);
  EXPECT_NEAR(rig.neutral.parts[0].gloss, 0.5, 1e-3);
}

TEST(GltfRig, BringsBackWhatOurExporterNotes) {
  const Rig rig =
      read(square_gltf(six_names, R"(,"facegraph":{"version":1,"vertex_count":4,"copies":[0],"inner_lips":[[3,0],[2,1]],
    "lower_lip":[0,1],"upper_teeth":[2],"landmarks68":[1,2,3],"parts":[{"name":"face","gloss":0.25}],"missing":["tongueOut"]})"));
  ASSERT_EQ(rig.inner_lips.size(), 2u);
  EXPECT_EQ(rig.inner_lips[0].upper, 3u);
  EXPECT_EQ(rig.inner_lips[1].lower, 1u);
  EXPECT_EQ(rig.lower_lip, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(rig.upper_teeth, std::vector<std::uint32_t>{2});
  EXPECT_EQ(rig.landmarks68, (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_EQ(rig.neutral.parts[0].name, "face");
  EXPECT_EQ(rig.neutral.parts[0].gloss, 0.25f);
  EXPECT_EQ(rig.missing, std::vector<std::string>{"tongueOut"});
}

TEST(GltfRig, RejectsNotesAboutVerticesThatAreNotThere) {
  EXPECT_THROW_TEXT(read(square_gltf(six_names, R"(,"facegraph":{"lower_lip":[0,17]})")),
                    "head.gltf at extras.facegraph.lower_lip: found vertex 17, expected one of 0 to 3");
}

TEST(GltfRig, RefusesAFileWithoutTheShapesThatSpeechNeeds) {
  EXPECT_THROW_TEXT(
      read(square_gltf(R"("jawOpen","mouthFunnel","mouthPucker","mouthRollLower","mouthRollUpper","smile")")),
      "head.gltf: lacks the shapes mouthClose; a rig needs jawOpen, mouthClose, mouthFunnel, mouthPucker, "
      "mouthRollLower, mouthRollUpper. Found jawOpen, mouthFunnel, mouthPucker, mouthRollLower, mouthRollUpper, smile");
}

TEST(GltfRig, RefusesAMeshWithoutMorphTargets) {
  std::string text = square_gltf(six_names);
  const std::size_t begin = text.find(",\"targets\":["), end = text.find(']', begin);
  text.erase(begin, end + 1 - begin);
  EXPECT_THROW_TEXT(read(text), "head.gltf: is not a rig: found a mesh of 5 vertices without morph targets");
}

TEST(GltfRig, RefusesAnAccessorThatReachesBeyondItsBuffer) {
  std::string text = square_gltf(six_names);
  const std::size_t at = text.find("\"count\":5,");
  text.replace(at, 10, "\"count\":50,");
  EXPECT_THROW_TEXT(read(text), "head.gltf accessor 0: reaches byte 600, its buffer has 100 and its view ends at 60");
}

TEST(GltfRig, RefusesWhatIsNoGltf) {
  EXPECT_THROW_TEXT(read("", "head.glb"), "head.glb: is empty (0 bytes), expected a GLB or glTF file");
  EXPECT_THROW_TEXT(
      read("This is a text.", "head.glb"),
      "head.glb: is not a rig: found neither \"glTF\" nor JSON at byte 0, expected an ICT-FaceKit folder, or a GLB "
      "or glTF file with morph targets");
}

TEST(GltfRig, ReadsBuffersFromTheFolderThatItWasGivenOnly) {
  std::string text = square_gltf(six_names);
  const std::size_t begin = text.find("data:application"), end = text.find('"', begin);
  text.replace(begin, end - begin, "head.bin");
  const test::Temporary temporary;
  temporary.write("rig/head.gltf", text);
  temporary.write("rig/head.bin", bytes_of_values<float>({0, 0, 0, 0.1f, 0, 0, 0.1f, 0.1f, 0, 0, 0.1f, 0, 0, 0, 0}) +
                                      bytes_of_values<float>({0, -0.01f, 0, 0, -0.01f, 0}) +
                                      bytes_of_values<std::uint16_t>({0, 1, 2, 4, 2, 3}) +
                                      bytes_of_values<std::uint16_t>({0, 4}));
  EXPECT_EQ(read_rig(test::folder_file(temporary.folder() / "rig"), nullptr).neutral.points_mm.size(), 4u);
  EXPECT_ANY_THROW(read_rig(engine::File::at(temporary.path("rig/head.gltf")), nullptr));
}
