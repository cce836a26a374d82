// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <opencv2/imgcodecs.hpp>

#include "nodes/decode/read_rig.h"
#include "nodes/types/arkit.h"
#include "tests/nodes/decode/temporary.h"
#include "tests/support/expect_throw_text.h"
#include "tests/support/folder_file.h"

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

// The same text with one part in place of another.
std::string with(std::string text, const std::string& part, const std::string& other) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), other);
}

// The square with a picture on it: red on the left, green on the right, black at the bottom (32 x 32), which its
// corners see at (0.25, 0.25), (0.75, 0.25), (0.75, 0.25) and (0.25, 0.9); the copy of vertex 0 lies on the green side.
std::string pictured_gltf(const std::string& suffix, const std::string& encoded_as = "") {
  cv::Mat picture(32, 32, CV_8UC3);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      picture.at<cv::Vec3b>(y, x) = y > 23 ? cv::Vec3b(0, 0, 0) : x < 16 ? cv::Vec3b(0, 0, 255) : cv::Vec3b(0, 255, 0);
  std::vector<unsigned char> encoded;
  cv::imencode(suffix, picture, encoded, {cv::IMWRITE_JPEG_QUALITY, 100});
  const std::string bytes = encoded_as.empty() ? std::string(encoded.begin(), encoded.end()) : encoded_as;
  const std::string uvs = bytes_of_values<float>({0.25f, 0.25f, 0.75f, 0.25f, 0.75f, 0.25f, 0.25f, 0.9f, 0.75f, 0.25f});
  std::string text = square_gltf(six_names);
  text = with(text, R"({"POSITION":0})", R"({"POSITION":0,"TEXCOORD_0":3})");
  text = with(text, R"("baseColorFactor":[1,0.2140411,0,1])", R"("baseColorTexture":{"index":0})");
  text = with(text, R"("count":6,"type":"SCALAR"})",
              R"("count":6,"type":"SCALAR"},{"bufferView":4,"componentType":5126,"count":5,"type":"VEC2"})");
  text = with(text, R"("byteOffset":96,"byteLength":4})",
              R"("byteOffset":96,"byteLength":4},{"buffer":1,"byteLength":40})");
  text.pop_back();  // }
  text.pop_back();  // ]
  return text + R"(,{"byteLength":40,"uri":"data:application/octet-stream;base64,)" + base64(uvs) +
         R"("}],"textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,)" + base64(bytes) + "\"}]}";
}

TEST(GltfRig, TakesTheColoursOfVerticesFromTheTexture) {
  for (const std::string suffix : {".png", ".jpg", ".webp"}) {
    const Mesh mesh = read(pictured_gltf(suffix)).neutral;
    ASSERT_EQ(mesh.points_mm.size(), 4u) << "a seam of two colours is still closed";
    ASSERT_EQ(mesh.colors_srgb.size(), 4u) << suffix;
    const double tolerance = suffix == ".png" ? 1e-3 : 0.15;
    const Vec3f expected[] = {{1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0, 0, 0}};
    for (std::size_t v = 0; v < 4; ++v)
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(mesh.colors_srgb[v][c], expected[v][c], tolerance) << suffix << v;
    EXPECT_EQ(mesh.parts[0].albedo_srgb, (Vec3f{1, 1, 1}));
  }
}

TEST(GltfRig, TrianglesThatATransparentTextureHardlyShowsAreNotDrawn) {
  cv::Mat picture(32, 32, CV_8UC4, cv::Scalar(0, 0, 0, 0));
  picture.rowRange(0, 8).setTo(cv::Scalar(0, 0, 255, 255));
  std::vector<unsigned char> encoded;
  cv::imencode(".png", picture, encoded);
  const std::string text = pictured_gltf(".png", std::string(encoded.begin(), encoded.end()));
  const std::string material = R"("materials":[{)";

  const Mesh plain = read(text).neutral;
  ASSERT_EQ(plain.parts.size(), 1u) << "an opaque material has no use for its texture's transparency";
  EXPECT_TRUE(plain.parts[0].visible);

  const Mesh cut = read(with(text, material, material + R"("alphaMode":"MASK","alphaCutoff":0.4,)")).neutral;
  ASSERT_EQ(cut.parts.size(), 2u);
  for (const std::size_t part : {0u, 1u}) {
    EXPECT_EQ(cut.parts[part].visible, part == 0);
    EXPECT_EQ(cut.parts[part].first_polygon, part);
    EXPECT_EQ(cut.parts[part].polygon_count, 1u);
  }
  EXPECT_EQ(cut.corners, plain.corners);
  // Three corners lie on the edge of what is seen: they are red and not half black.
  for (std::size_t v = 0; v < 3; ++v) EXPECT_NEAR(cut.colors_srgb[v][0], 1, 1e-3) << v;

  const Mesh shown = read(with(text, material, material + R"("alphaMode":"MASK","alphaCutoff":0.6,)")).neutral;
  ASSERT_EQ(shown.parts.size(), 1u);
  EXPECT_FALSE(shown.parts[0].visible);
}

TEST(GltfRig, PrefersTheWebpPictureOfATexture) {
  const std::string webp = R"("textures":[{"extensions":{"EXT_texture_webp":{"source":0}}}])";
  const Mesh mesh = read(with(pictured_gltf(".webp"), R"("textures":[{"source":0}])", webp)).neutral;
  ASSERT_EQ(mesh.colors_srgb.size(), 4u);
  EXPECT_NEAR(mesh.colors_srgb[0][0], 1, 0.15);
  EXPECT_NEAR(mesh.colors_srgb[0][1], 0, 0.15);
}

TEST(GltfRig, DoesWithoutATextureThatCannotBeRead) {
  for (const std::string bytes : {"\xABKTX 20\xBB of some kind", "\x89PNG and then nothing"}) {
    const Mesh mesh = read(pictured_gltf(".png", bytes)).neutral;
    EXPECT_TRUE(mesh.colors_srgb.empty());
    EXPECT_EQ(mesh.parts[0].albedo_srgb, Part().albedo_srgb);
  }
}

TEST(GltfRig, FindsNamesWhereOtherExportersWriteThem) {
  const std::string plain = square_gltf(six_names);
  const std::string named = std::string(R"(,"extras":{"targetNames":[)") + six_names + "]}";
  // UniVRM and FBX2glTF: at the primitive.
  Rig rig = read(with(with(plain, named, ""), R"("material":0,)", R"("material":0)" + named + ","));
  EXPECT_FALSE(rig.shapes[arkit_index("mouthPucker")].vertices.empty());
  // Others: as names of the accessors; here all six targets share one.
  EXPECT_THROW_TEXT(read(with(with(plain, named, ""), R"({"componentType":5126,)",
                              R"({"name":"Face.jawOpen","componentType":5126,)")),
                    "head.gltf: lacks the shapes mouthClose, mouthFunnel, mouthPucker, mouthRollLower, mouthRollUpper; "
                    "a rig needs jawOpen, mouthClose, mouthFunnel, mouthPucker, mouthRollLower, mouthRollUpper. Found "
                    "jawOpen");
}

TEST(GltfRig, PlacesASkinnedHeadWhereItsJointsAre) {
  // The joint lies below an armature that is twice as large and turned by -90 degrees about x, and undoes a bind pose
  // 1 m off. The mesh's own node does not count. Weights that do not add up to 1 count as if they did.
  std::string bytes = bytes_of_values<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 1});
  for (int v = 0; v < 5; ++v) bytes += bytes_of_values<float>({0.5f, 0, 0, 0});
  bytes += std::string(20, '\0');
  std::string text = square_gltf(six_names);
  text = with(text, R"("nodes":[0]}])", R"("nodes":[0,1]}])");
  text = with(text, R"("nodes":[{"mesh":0,)",
              R"("skins":[{"joints":[2],"inverseBindMatrices":3}],"nodes":[{"mesh":0,"skin":0,)");
  text = with(text, R"("scale":[2,2,2]}])",
              R"("scale":[2,2,2]},{"children":[2],"scale":[2,2,2],"rotation":[-0.70710678,0,0,0.70710678]},
                 {"translation":[0,0,1]}])");
  text = with(text, R"("attributes":{"POSITION":0})", R"("attributes":{"POSITION":0,"JOINTS_0":4,"WEIGHTS_0":5})");
  text = with(text, R"("count":6,"type":"SCALAR"}])",
              R"("count":6,"type":"SCALAR"},{"bufferView":4,"componentType":5126,"count":1,"type":"MAT4"},
                 {"bufferView":6,"componentType":5121,"count":5,"type":"VEC4"},
                 {"bufferView":5,"componentType":5126,"count":5,"type":"VEC4"}])");
  text = with(text, R"("byteOffset":96,"byteLength":4}])",
              R"("byteOffset":96,"byteLength":4},{"buffer":1,"byteLength":64},
                 {"buffer":1,"byteOffset":64,"byteLength":80},{"buffer":1,"byteOffset":144,"byteLength":20}])");
  text.erase(text.rfind("]}"));
  text += R"(,{"byteLength":164,"uri":"data:application/octet-stream;base64,)" + base64(bytes) + "\"}]}";
  const Rig rig = read(text);
  const Vec3f& corner = rig.neutral.points_mm[2];
  EXPECT_NEAR(corner[0], 200, 1e-3);
  EXPECT_NEAR(corner[1], 0, 1e-3);
  EXPECT_NEAR(corner[2], -200, 1e-3);
  EXPECT_NEAR(rig.shapes[arkit_index("jawOpen")].offsets_mm[0][2], 20, 1e-3);
}

TEST(GltfRig, TurnsTrianglesOfAMirroredNodeRound) {
  const Rig rig = read(with(square_gltf(six_names), R"("scale":[2,2,2])", R"("scale":[-2,2,2])"));
  EXPECT_EQ(rig.neutral.corners, (std::vector<std::uint32_t>{0, 2, 1, 0, 3, 2}));
  EXPECT_NEAR(rig.neutral.points_mm[1][0], -200, 1e-3);
}

TEST(GltfRig, ReadsQuantisedMeshes) {
  // KHR_mesh_quantization: positions and offsets as 16-bit integers, brought to size by the node.
  std::string text = square_gltf(six_names);
  const std::string data =
      bytes_of_values<std::int16_t>({0, 0, 0, 0, 16384, 0, 0, 0, 16384, 16384, 0, 0, 0, 16384, 0, 0, 0, 0, 0, 0}) +
      bytes_of_values<std::int16_t>({0, -1638, 0, 0, -1638, 0}) + bytes_of_values<std::uint16_t>({0, 1, 2, 4, 2, 3}) +
      bytes_of_values<std::uint16_t>({0, 4});
  const std::size_t uri = text.find("base64,") + 7;
  text.replace(uri, text.find('"', uri) - uri, base64(data));
  text =
      with(text, R"("bufferViews":[{"buffer":0,"byteLength":60},{"buffer":0,"byteOffset":60,"byteLength":24},
      {"buffer":0,"byteOffset":84,"byteLength":12},{"buffer":0,"byteOffset":96,"byteLength":4}])",
           R"("bufferViews":[{"buffer":0,"byteLength":40,"byteStride":8},{"buffer":0,"byteOffset":40,"byteLength":12},
      {"buffer":0,"byteOffset":52,"byteLength":12},{"buffer":0,"byteOffset":64,"byteLength":4}])");
  text = with(text, R"("byteLength":100,)", R"("byteLength":68,)");
  text = with(text, R"({"bufferView":0,"componentType":5126,)",
              R"({"bufferView":0,"normalized":true,"componentType":5122,)");
  text = with(text, R"({"componentType":5126,)", R"({"normalized":true,"componentType":5122,)");
  text = with(text, R"("scale":[2,2,2])", R"("scale":[0.4,0.4,0.4])");
  text = with(text, R"({"asset")",
              R"({"extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"],"asset")");
  const Rig rig = read(text);
  EXPECT_NEAR(rig.neutral.points_mm[2][0], 200, 0.1);
  EXPECT_NEAR(rig.shapes[arkit_index("jawOpen")].offsets_mm[0][1], -20, 0.1);
}

TEST(GltfRig, RefusesNodesThatAreNoTree) {
  EXPECT_THROW_TEXT(read(with(square_gltf(six_names), R"({"mesh":0,)", R"({"mesh":0,"children":[0],)")),
                    "head.gltf: node 0 has two parents, or is its own ancestor, expected a tree of nodes");
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
      "mouthRollLower, mouthRollUpper. Found jawOpen, mouthFunnel, mouthPucker, mouthRollLower, mouthRollUpper, smile; "
      "names "
      "that are not ARKit's are mapped by a file, which facegraph doctor proposes");
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
  EXPECT_THROW_TEXT(read_rig(engine::File::at(temporary.path("rig/head.gltf")), nullptr),
                    "head.gltf: its buffers lie in files beside it: give the folder that holds them all, or export one "
                    ".glb (File not found : head.bin)");
}
