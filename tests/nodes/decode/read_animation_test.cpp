// SPDX-License-Identifier: Apache-2.0
// What our exporters write is read back in tests/nodes/export/meshes_test.cpp; here are other programs' ways.
#include "nodes/decode/read_animation.h"

#include <cstring>

#include "nodes/decode/read_points.h"
#include "nodes/types/arkit.h"
#include "tests/nodes/decode/temporary.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::decode;

namespace {

std::string bytes_of(const std::vector<float>& values) {
  std::string out(values.size() * 4, '\0');
  std::memcpy(out.data(), values.data(), out.size());
  return out;
}

// Two meshes with weights of their own: the head's jaw linearly from 0 to 1 in a second, the teeth's jaw (which does
// not count, as the head has one) and a shape of their own as a spline with three keys.
engine::File two_meshes(const test::Temporary& temporary, const std::string& animations) {
  const std::string data = bytes_of({0, 0, 0, 1, 0, 0, 0, 1, 0}) + bytes_of({0, 1}) + bytes_of({0, 1}) +
                           bytes_of({0, 0.5f, 1}) +
                           bytes_of({9, 9, 0.25f, 0.125f, 9, 9, 9, 9, 0.5f, 0.75f, 9, 9, 9, 9, 1, 0.25f, 9, 9});
  const std::string text =
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0},{"mesh":1}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":0}]}],"extras":{"targetNames":["head.Jaw_Open"]}},
      {"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":0},{"POSITION":0}]}],"extras":{"targetNames":["jawOpen","Key7"]}}],)" +
      animations +
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
      {"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
      {"bufferView":2,"componentType":5126,"count":2,"type":"SCALAR"},
      {"bufferView":3,"componentType":5126,"count":3,"type":"SCALAR","min":[0],"max":[1]},
      {"bufferView":4,"componentType":5126,"count":18,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":8},{"buffer":0,"byteOffset":44,"byteLength":8},
      {"buffer":0,"byteOffset":52,"byteLength":12},{"buffer":0,"byteOffset":64,"byteLength":72}],
    "buffers":[{"byteLength":)" +
      std::to_string(data.size()) + R"(,"uri":"data.bin"}]})";
  return engine::File::folder(temporary.folder().string(), {{"data.bin", temporary.write("data.bin", data)},
                                                            {"head.gltf", temporary.write("head.gltf", text)}});
}

const char* both = R"("animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}},
    {"sampler":1,"target":{"node":1,"path":"weights"}}],
  "samplers":[{"input":1,"output":2},{"input":3,"output":4,"interpolation":"CUBICSPLINE"}]}],)";

}  // namespace

TEST(ReadAnimation, GathersMeshesWhoseKeysAreAtOtherTimes) {
  const test::Temporary temporary;
  const auto result = read_animation(two_meshes(temporary, both), nullptr);
  EXPECT_EQ(result.timeline.time_s, (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(result.timeline.duration_s, 1.5);
  ASSERT_EQ(result.weights.size(), 3u);
  const std::vector<float>& middle = result.weights.at(1)->values;
  ASSERT_EQ(middle.size(), arkit_count + 1);
  EXPECT_EQ(middle[arkit_index("jawOpen")], 0.5f);  // the head's, between its keys
  EXPECT_EQ(middle[arkit_count], 0.75f);            // the value of a spline's key, not its tangents
  EXPECT_EQ(result.weights.at(0)->values[arkit_count], 0.125f);
}

TEST(ReadAnimation, TakesNamesFromAFile) {
  const test::Temporary temporary;
  const engine::File names = engine::File::at(temporary.write("names.json", R"({"Key7": "tongueOut"})"));
  const auto result = read_animation(two_meshes(temporary, both), &names);
  EXPECT_EQ(result.weights.at(1)->values.size(), arkit_count);
  EXPECT_EQ(result.weights.at(1)->values[arkit_index("tongueOut")], 0.75f);
}

TEST(ReadAnimation, RefusesAGltfThatMovesNoShapes) {
  const test::Temporary temporary;
  EXPECT_THROW_TEXT(read_animation(two_meshes(temporary, ""), nullptr), "head.gltf: found no animation");
  EXPECT_THROW_TEXT(
      read_animation(
          two_meshes(temporary, R"("animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"scale"}}],
        "samplers":[{"input":1,"output":2}]}],)"),
          nullptr),
      "head.gltf: its first animation moves no morph targets");
}

TEST(ReadAnimation, CountsFromTheFirstTimecode) {
  const test::Temporary temporary;
  const auto result =
      read_animation(engine::File::at(temporary.write("take.csv",
                                                      "Timecode,BlendShapeCount,EyeBlinkLeft,JawOpen,HeadYaw\n"
                                                      "11:59:59:30.500,61,0.5,0,0.1\n12:00:00:00.500,61,0,1,0.2\n")),
                     nullptr, {.timecode_rate_hz = 60});
  ASSERT_EQ(result.weights.size(), 2u);
  EXPECT_EQ(result.timeline.time_s[0], 0);
  EXPECT_NEAR(result.timeline.time_s[1], 0.5, 1e-9);
  EXPECT_EQ(result.weights.at(0)->values[arkit_index("eyeBlinkLeft")], 0.5f);
  EXPECT_EQ(result.weights.at(1)->values[arkit_index("jawOpen")], 1);
  EXPECT_EQ(result.weights.at(1)->values.size(), arkit_count);  // angles of the head are left out
}

TEST(ReadPoints, ReadsAPointCacheOfAnotherProgramInCentimetres) {
  std::string bytes("POINTCACHE2\0", 12);
  const auto put = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(std::int32_t{1}), put(std::int32_t{2}), put(1.0f), put(0.5f), put(std::int32_t{2});
  for (const float x : {0.0f, 0.0f, 0.0f, 0.0f, 24.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 25.0f, 0.0f}) put(x);
  const auto points = read_points(engine::File::from_bytes(bytes, ".pc2"));
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points.at(0)->points_mm[1], (Vec3f{0, 240, 0}));
  EXPECT_EQ(points.at(1)->points_mm[0], (Vec3f{0, 10, 0}));
  bytes[12] = 2;
  EXPECT_THROW_TEXT(read_points(engine::File::from_bytes(bytes, ".pc2")), "the data: found version 2, expected 1");
}
