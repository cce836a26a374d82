// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_model.h"

#include <gtest/gtest.h>

#include "nodes/base/srgb.h"
#include "nodes/decode/zip_file.h"
#include "tests/support/expect_throw_text.h"
#include "tests/support/model_files.h"

namespace {

using face::MorphableModel;
using face::Vec3f;
using face::decode::read_model;

// A triangle in mm; one component of 2 mm along x for its first vertex.
const std::vector<float> corners = {-80, 0, 0, 80, 0, 0, 0, 200, 10};
const std::vector<float> along_x = {1, 0, 0, 0, 0, 0, 0, 0, 0};

std::string shape() { return test::eos_pca(corners, along_x, {4}, {0, 1, 2}); }
std::string no_colour() { return test::eos_pca({}, {}, {}, {}); }
std::string no_uvs() { return test::raw(std::uint64_t{0}); }
std::string bin(std::uint32_t version, const std::string& rest) { return test::raw(version) + rest; }

engine::File file(const std::string& bytes, const std::string& suffix) {
  return engine::File::from_bytes(bytes, suffix);
}
MorphableModel read(const std::string& bytes, const std::string& suffix = ".bin",
                    const face::decode::ReadModelOptions& options = {}) {
  return read_model(file(bytes, suffix), nullptr, nullptr, options);
}
MorphableModel read_flame(const std::map<std::string, std::string>& arrays, bool deflated = false) {
  return read(test::zip(arrays, deflated), ".npz", {.identities = 2});
}

}  // namespace

TEST(ReadModel, ReadsAModelOfShapesAloneThatEosSaved) {
  const MorphableModel model = read(bin(1, shape() + no_colour() + no_uvs()));
  ASSERT_EQ(model.mean.points_mm.size(), 3u);
  EXPECT_EQ(model.mean.points_mm[2], (Vec3f{0, 200, 10}));
  EXPECT_EQ(model.mean.corners, (std::vector<std::uint32_t>{0, 1, 2}));
  ASSERT_EQ(model.identity.size(), 1u);
  EXPECT_EQ(model.identity.modes[0], (Vec3f{2, 0, 0}));  // the eigenvector times the root of its eigenvalue
  EXPECT_EQ(model.identity.sigmas[0], 1);
  EXPECT_EQ(model.expression.size(), 0u);
  EXPECT_TRUE(model.mean_albedo.empty());
  EXPECT_TRUE(model.landmarks68.empty());
}

TEST(ReadModel, ReadsColoursAsReflectance) {
  const std::string colour = test::eos_pca({0.5f, 0.5f, 0.5f, 0, 0, 0, 1, 1, 1}, along_x, {0.0001f}, {0, 1, 2});
  const MorphableModel model = read(bin(1, shape() + colour + no_uvs()));
  ASSERT_EQ(model.mean_albedo.size(), 3u);
  EXPECT_NEAR(model.mean_albedo[0][0], face::linear_of(0.5), 1e-6);
  EXPECT_NEAR(model.mean_albedo[2][1], 1, 1e-6);
  ASSERT_EQ(model.albedo.size(), 1u);
  // One standard deviation is 0.01 of sRGB: the difference of the curve there.
  EXPECT_NEAR(model.albedo.modes[0][0], face::linear_of(0.505) - face::linear_of(0.495), 1e-5);
}

TEST(ReadModel, ReadsExpressionsLandmarksAndTextureOfNewerFiles) {
  std::string landmarks = test::raw(std::uint8_t{0}) + test::raw(std::uint64_t{68});
  for (int i = 68; i > 0; --i) landmarks += test::eos_text(std::to_string(i)) + test::raw(std::int32_t{i % 3});
  const std::string shapes =
      test::raw(std::uint8_t{0}) + test::raw(std::int32_t{0}) + test::eos_blend_shapes({{"smile", along_x}});
  std::string uvs = test::raw(std::uint64_t{3});
  for (const double value : {0.0, 0.0, 1.0, 0.0, 0.5, 0.75}) uvs += test::raw(value);
  const MorphableModel model =
      read(bin(4, shape() + no_colour() + shapes + landmarks + uvs + test::eos_triples({0, 2, 1})));
  ASSERT_EQ(model.expression.size(), 1u);
  EXPECT_EQ(model.expression.names[0], "smile");
  EXPECT_EQ(model.expression.modes[0], (Vec3f{1, 0, 0}));
  ASSERT_EQ(model.landmarks68.size(), 68u);
  EXPECT_EQ(model.landmarks68[0], 1u);
  EXPECT_EQ(model.mean.corner_uvs, (std::vector<std::uint32_t>{0, 2, 1}));
  EXPECT_EQ(model.mean.uvs[2], (face::Vec2f{0.5f, 0.25f}));
}

TEST(ReadModel, TakesBlendShapesOfASecondFile) {
  const engine::File shapes = file(test::eos_blend_shapes({{"open", along_x}, {"smile", along_x}}), ".bin");
  const MorphableModel model = read_model(file(bin(1, shape() + no_colour() + no_uvs()), ".bin"), &shapes, nullptr);
  EXPECT_EQ(model.expression.names, (std::vector<std::string>{"open", "smile"}));
  const engine::File other = file(test::eos_blend_shapes({{"open", {1, 0, 0}}}), ".bin");
  EXPECT_THROW_TEXT(read_model(file(bin(1, shape() + no_colour() + no_uvs()), ".bin"), &other, nullptr),
                    "the data: blend shape \"open\" has 1 vertices, the model 3");
}

TEST(ReadModel, SaysWhatIsWrongWithAnArchive) {
  EXPECT_THROW_TEXT(read(bin(0, "")),
                    "the data: found version 0 of eos's models, expected 1 to 4 (version 0 is of 2016: download the "
                    "model again)");
  EXPECT_THROW_TEXT(read(bin(1, shape())), "the data byte " + std::to_string(4 + shape().size()) +
                                               ": the file ends within a number of the model, expected 4 bytes more");
  EXPECT_THROW_TEXT(read(bin(1, test::raw(std::int32_t{1 << 30}) + test::raw(std::int32_t{3}) + "abcd")),
                    "the data byte 4: found a mean of 1073741824 x 3 numbers, but only 4 bytes follow: is this a model "
                    "that eos saved (version 1 or newer)?");
  EXPECT_THROW_TEXT(read(bin(1, test::eos_pca(corners, along_x, {4}, {0, 1, 7}) + no_colour() + no_uvs())),
                    "the data: a triangle has vertex 7, expected one below 3");
  EXPECT_THROW_TEXT(read(bin(1, shape() + no_colour() + no_uvs() + "x")),
                    "the data byte " + std::to_string(4 + shape().size() + no_colour().size() + 8) +
                        ": 1 bytes are left over, expected the end");
}

TEST(ReadModel, ReadsAFlameLikeModelInMetres) {
  for (const bool deflated : {false, true}) {
    const MorphableModel model = read_flame(test::flame_arrays(), deflated);
    ASSERT_EQ(model.mean.points_mm.size(), 4u);
    EXPECT_NEAR(model.mean.points_mm[1][0], 80, 1e-4);
    EXPECT_EQ(model.mean.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    ASSERT_EQ(model.identity.size(), 2u);
    ASSERT_EQ(model.expression.size(), 1u);
    EXPECT_NEAR(model.identity.modes[0][0], 1, 1e-5);    // x of vertex 0, component 0
    EXPECT_NEAR(model.identity.modes[4][1], 2, 1e-5);    // y of vertex 0, component 1
    EXPECT_NEAR(model.expression.modes[0][2], 3, 1e-5);  // z of vertex 0, component 2
    EXPECT_NEAR(model.expression.modes[3][0], 4, 1e-5);  // x of vertex 3, component 2
  }
}

TEST(ReadModel, OpensAFlameLikeJaw) {
  auto arrays = test::flame_arrays();
  arrays["v_template.npy"] = test::npy("(4, 3)", {-0.08, -0.1, 0.05, 0.08, -0.1, 0.05, 0.08, 0.1, 0, -0.08, 0.1, 0});
  arrays["weights.npy"] = test::npy("(4, 3)", {0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0});
  arrays["J_regressor.npy"] = test::npy("(3, 4)", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.5, 0.5});  // the jaw at the top
  const MorphableModel model = read_flame(arrays);
  ASSERT_EQ(model.expression.names.back(), "jaw_open");
  const Vec3f chin = model.expression.modes[4], brow = model.expression.modes[6];
  EXPECT_NEAR(chin[1], -0.15 * 50, 1e-4);   // the chin goes down
  EXPECT_NEAR(chin[2], -0.15 * 200, 1e-4);  // and back, as it lies below the joint
  EXPECT_EQ(brow, (Vec3f{0, 0, 0}));
}

TEST(ReadModel, SaysWhatIsWrongWithArrays) {
  auto arrays = test::flame_arrays();
  arrays.erase("f.npy");
  EXPECT_THROW_TEXT(read_flame(arrays),
                    "the data: holds no array f, expected v_template, f and shapedirs. Found "
                    "shapedirs.npy, v_template.npy");
  arrays = test::flame_arrays();
  arrays["v_template.npy"] = test::npy("(3, 3)", {0, 0, 0, 1, 0, 0, 0, 1, 0});
  EXPECT_THROW_TEXT(read_flame(arrays), "the data: shapedirs has 4 x 9 numbers, expected 3 x 3 x K");
  std::string damaged = test::zip(test::flame_arrays());
  damaged[damaged.find("NUMPY") + 30] ^= 1;
  EXPECT_THROW(read(damaged, ".npz"), std::exception);
  EXPECT_THROW_TEXT(read("no archive", ".npz"), "the data: is no ZIP archive, or cut off: found no end of its list");
}

TEST(ReadModel, NeedsAModelFile) {
  EXPECT_THROW_TEXT(read("", ".pkl"),
                    "the data: a pickle can hold any program and is not opened; save v_template, f, shapedirs, weights "
                    "and J_regressor with numpy.savez instead");
  EXPECT_THROW_TEXT(read("", ".txt"),
                    "the data: found a file \".txt\", expected a morphable model: .bin of eos, .npz "
                    "or .glb (an ICT-FaceKit folder: model.from_rig)");
}

TEST(ReadModel, TakesLandmarksFromAList) {
  std::string list = "[0";
  for (int i = 1; i < 68; ++i) list += "," + std::to_string(i % 3);
  const engine::File landmarks = file(list + "]", ".json"), few = file("[1, 2]", ".json");
  const engine::File given = file(bin(1, shape() + no_colour() + no_uvs()), ".bin");
  EXPECT_EQ(read_model(given, nullptr, &landmarks).landmarks68[5], 2u);
  EXPECT_THROW_TEXT(read_model(given, nullptr, &few),
                    "the data: found a list of 2, expected a list of 68 vertices (Multi-PIE's points in their order)");
}

TEST(ZipFile, FindsADamagedFile) {
  std::string bytes = test::zip({{"a.txt", "hello"}});
  EXPECT_EQ(face::decode::read_zip(file(bytes, ".zip")).at("a.txt"), "hello");
  bytes[bytes.find("hello")] = 'j';
  EXPECT_THROW_TEXT(face::decode::read_zip(file(bytes, ".zip")),
                    "the data: a.txt is damaged: its checksum is 1288762854, expected 907060870");
}
