// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_gltf.h"

#include <gtest/gtest.h>
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "nodes/base/pose.h"
#include "nodes/decode/read_rig.h"
#include "nodes/phantom/make_head.h"
#include "tests/nodes/export/test_head.h"
#include "tests/support/expect_throw_text.h"

namespace face::exports {
namespace {

Timeline at_60_hz(std::size_t frames) {
  Timeline timeline;
  for (std::size_t i = 0; i < frames; ++i) timeline.time_s.push_back(static_cast<double>(i) / 60.0);
  timeline.duration_s = static_cast<double>(frames) / 60.0;
  return timeline;
}

engine::Seq<Weights> three_frames() {
  Weights full;
  for (std::size_t s = 0; s < arkit_count; ++s) full.values.push_back(static_cast<float>(s) / 64.0f);
  return engine::Seq<Weights>({Weights{}, full, Weights{{0.25f}}});
}

tinygltf::Model parsed(const engine::File& file) {
  tinygltf::TinyGLTF reader;
  tinygltf::Model model;
  std::string error, warning;
  const std::string& bytes = file.bytes();
  const bool read =
      reader.LoadBinaryFromMemory(&model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
                                  static_cast<unsigned int>(bytes.size()));
  EXPECT_TRUE(read) << error;
  EXPECT_EQ(warning, "");
  return model;
}

// Floats of an accessor, with its sparse elements put in.
std::vector<float> values_of(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(index));
  const auto width =
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  std::vector<float> values(accessor.count * width, 0.0f);
  const auto place = [&](int view) {
    const tinygltf::BufferView& v = model.bufferViews.at(static_cast<std::size_t>(view));
    return model.buffers[0].data.data() + v.byteOffset;
  };
  if (accessor.bufferView >= 0) std::memcpy(values.data(), place(accessor.bufferView), values.size() * sizeof(float));
  if (accessor.sparse.isSparse)
    for (std::size_t i = 0; i < static_cast<std::size_t>(accessor.sparse.count); ++i) {
      std::uint32_t element = 0;
      std::memcpy(&element, place(accessor.sparse.indices.bufferView) + i * 4, 4);
      std::memcpy(&values.at(element * width), place(accessor.sparse.values.bufferView) + i * 4 * width, 4 * width);
    }
  return values;
}

TEST(ExportGltf, ComesBackWithTheSamePositionsShapesAndWeights) {
  const Rig rig = test::square_rig();
  const engine::Seq<Weights> frames = three_frames();
  const tinygltf::Model model = parsed(export_gltf(rig, frames, at_60_hz(3)));
  ASSERT_EQ(model.meshes.size(), 1u);
  ASSERT_EQ(model.meshes[0].primitives.size(), 2u);
  const tinygltf::Primitive& primitive = model.meshes[0].primitives[0];
  const std::vector<float> positions = values_of(model, primitive.attributes.at("POSITION"));
  ASSERT_EQ(positions.size(), (6u + 2u) * 3u);  // the two vertices on the seam are there twice
  for (std::size_t v = 0; v < 6; ++v)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_FLOAT_EQ(positions[v * 3 + axis], rig.neutral.points_mm[v][axis] / 1000);
  ASSERT_EQ(primitive.targets.size(), arkit_count);
  const std::vector<float> jaw = values_of(model, primitive.targets[arkit_index("jawOpen")].at("POSITION"));
  EXPECT_FLOAT_EQ(jaw[1 * 3 + 1], -0.006f);
  EXPECT_FLOAT_EQ(jaw[1 * 3 + 2], 0.001f);
  EXPECT_FLOAT_EQ(jaw[4 * 3 + 1], 0);
  // The copies on the seam move with their originals.
  const tinygltf::Value facegraph = model.meshes[0].extras.Get("facegraph");
  ASSERT_EQ(facegraph.Get("copies").ArrayLen(), 2u);
  for (int i = 0; i < 2; ++i) {
    const auto original = static_cast<std::size_t>(facegraph.Get("copies").Get(i).GetNumberAsInt());
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(jaw[(6 + static_cast<std::size_t>(i)) * 3 + axis], jaw[original * 3 + axis]);
  }
  const tinygltf::AnimationSampler& sampler = model.animations.at(0).samplers.at(0);
  const std::vector<float> times = values_of(model, sampler.input), weights = values_of(model, sampler.output);
  EXPECT_FLOAT_EQ(times.at(2), 2 / 60.0f);
  ASSERT_EQ(weights.size(), 3 * arkit_count);
  EXPECT_EQ(weights[0], 0);
  for (std::size_t s = 0; s < arkit_count; ++s) EXPECT_EQ(weights[arkit_count + s], frames.at(1)->values[s]);
  EXPECT_EQ(weights[2 * arkit_count], 0.25f);
  EXPECT_EQ(weights[2 * arkit_count + 1], 0);
}

TEST(ExportGltf, NamesEveryShapeAndEveryMark) {
  const Rig rig = test::square_rig();
  const tinygltf::Model model = parsed(export_gltf(rig, three_frames(), at_60_hz(3)));
  const tinygltf::Value& extras = model.meshes[0].extras;
  ASSERT_EQ(extras.Get("targetNames").ArrayLen(), arkit_count);
  for (std::size_t s = 0; s < arkit_count; ++s)
    EXPECT_EQ(extras.Get("targetNames").Get(static_cast<int>(s)).Get<std::string>(), arkit_names[s]);
  const tinygltf::Value facegraph = extras.Get("facegraph");
  EXPECT_EQ(facegraph.Get("vertex_count").GetNumberAsInt(), 6);
  EXPECT_EQ(facegraph.Get("inner_lips").Get(0).Get(0).GetNumberAsInt(), 4);
  EXPECT_EQ(facegraph.Get("inner_lips").Get(0).Get(1).GetNumberAsInt(), 1);
  EXPECT_EQ(facegraph.Get("lower_lip").ArrayLen(), 2u);
  EXPECT_EQ(facegraph.Get("upper_teeth").Get(0).GetNumberAsInt(), 3);
  EXPECT_EQ(facegraph.Get("landmarks68").ArrayLen(), 0u);
  EXPECT_EQ(facegraph.Get("missing").Get(0).Get<std::string>(), "tongueOut");
  EXPECT_EQ(facegraph.Get("parts").Get(1).Get("name").Get<std::string>(), "lashes");
}

TEST(ExportGltf, KeepsShapesThatMoveNothingAsZeros) {
  const tinygltf::Model model = parsed(export_gltf(test::square_rig(), three_frames(), at_60_hz(3)));
  const int accessor = model.meshes[0].primitives[0].targets[arkit_index("tongueOut")].at("POSITION");
  EXPECT_EQ(model.accessors[static_cast<std::size_t>(accessor)].bufferView, -1);
  EXPECT_FALSE(model.accessors[static_cast<std::size_t>(accessor)].sparse.isSparse);
  EXPECT_EQ(model.accessors[static_cast<std::size_t>(accessor)].count, 8u);
}

TEST(ExportGltf, LeavesOutPartsThatAreNotVisible) {
  Rig rig = test::square_rig();
  rig.neutral.parts[1].visible = false;
  const tinygltf::Model model = parsed(export_gltf(rig, three_frames(), at_60_hz(3)));
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_EQ(model.materials[0].name, "face");
}

TEST(ExportGltf, HasNoSeamsWithoutTextureCoordinates) {
  Rig rig = test::square_rig();
  rig.neutral.uvs.clear();
  rig.neutral.corner_uvs.clear();
  rig.neutral.parts.clear();
  const tinygltf::Model model = parsed(export_gltf(rig, three_frames(), at_60_hz(3)));
  const tinygltf::Primitive& primitive = model.meshes[0].primitives.at(0);
  EXPECT_EQ(values_of(model, primitive.attributes.at("POSITION")).size(), 6u * 3u);
  EXPECT_EQ(primitive.attributes.count("TEXCOORD_0"), 0u);
}

TEST(ExportGltf, BringsTheEmbeddedHeadBackWithItsMarks) {
  const Rig rig = phantom::make_head();
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "export_gltf_round_trip.glb";
  std::ofstream(path, std::ios::binary) << export_gltf(rig, engine::Seq<Weights>({Weights{}}), at_60_hz(1)).bytes();
  const Rig back = decode::read_rig(engine::File::at(path.string()), nullptr);
  std::filesystem::remove(path);
  ASSERT_EQ(back.neutral.points_mm.size(), rig.neutral.points_mm.size());
  ASSERT_EQ(back.inner_lips.size(), rig.inner_lips.size());
  for (std::size_t i = 0; i < rig.inner_lips.size(); ++i) {
    EXPECT_EQ(back.inner_lips[i].upper, rig.inner_lips[i].upper);
    EXPECT_EQ(back.inner_lips[i].lower, rig.inner_lips[i].lower);
  }
  EXPECT_EQ(back.lower_lip, rig.lower_lip);
  EXPECT_EQ(back.upper_teeth, rig.upper_teeth);
  EXPECT_EQ(back.landmarks68, rig.landmarks68);
  // Every shape at once: positions agree to a thousandth of a millimetre (they were metres in between).
  Weights weights;
  for (std::size_t s = 0; s < arkit_count; ++s) weights.values.push_back(static_cast<float>(s % 5) / 5.0f);
  const std::vector<Vec3f> before = pose_points(rig, weights), after = pose_points(back, weights);
  for (std::size_t v = 0; v < before.size(); ++v)
    for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_NEAR(after[v][axis], before[v][axis], 1e-3) << "vertex " << v;
  ASSERT_EQ(back.neutral.parts.size(), rig.neutral.parts.size());
  for (std::size_t p = 0; p < rig.neutral.parts.size(); ++p)
    EXPECT_EQ(back.neutral.parts[p].name, rig.neutral.parts[p].name);
}

TEST(ExportGltf, GivesTheSameBytesTwice) {
  const Rig rig = test::square_rig();
  EXPECT_EQ(export_gltf(rig, three_frames(), at_60_hz(3)).bytes(),
            export_gltf(rig, three_frames(), at_60_hz(3)).bytes());
}

TEST(ExportGltf, RejectsWhatDoesNotFitTogether) {
  const Rig rig = test::square_rig();
  EXPECT_THROW_TEXT(export_gltf(rig, {}, {}), "there are no frames to export");
  EXPECT_THROW_TEXT(export_gltf(rig, three_frames(), at_60_hz(2)), "there are 3 frames, but the timeline has 2 times");
  Timeline backwards = at_60_hz(3);
  backwards.time_s = {0, 0.5, 0.25};
  EXPECT_THROW_TEXT(export_gltf(rig, three_frames(), backwards),
                    "frame 2 of the timeline is at 0.25 s, expected more than 0.5 s");
  Timeline short_one = at_60_hz(3);
  short_one.duration_s = 0.01;
  EXPECT_THROW_TEXT(export_gltf(rig, three_frames(), short_one),
                    "the timeline ends at 0.01 s, expected after its last frame at 0.0333333 s");
  const engine::Seq<Weights> long_one({Weights{}, Weights{std::vector<float>(60, 0)}}, {"7", "9"});
  EXPECT_THROW_TEXT(export_gltf(rig, long_one, at_60_hz(2)), "frame 9 has 60 weights, but the rig has 52 shapes");
  const engine::Seq<Weights> odd({Weights{}, Weights{{0, std::nanf("")}}}, {"7", "9"});
  EXPECT_THROW_TEXT(export_gltf(rig, odd, at_60_hz(2)), "weight eyeLookDownLeft of frame 9 is not a finite number");
  Rig bare = rig;
  bare.shapes.clear();
  EXPECT_THROW_TEXT(export_gltf(bare, engine::Seq<Weights>({Weights{}}), at_60_hz(1)),
                    "the rig has no shapes, so there is nothing to animate");
}

}  // namespace
}  // namespace face::exports
