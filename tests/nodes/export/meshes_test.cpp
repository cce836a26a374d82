// SPDX-License-Identifier: Apache-2.0
// Meshes, animations of vertices, and recordings: what is written is read back.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "nodes/decode/read_animation.h"
#include "nodes/decode/read_audio.h"
#include "nodes/decode/read_mesh.h"
#include "nodes/decode/read_points.h"
#include "nodes/export/export_gltf.h"
#include "nodes/export/export_live_link_csv.h"
#include "nodes/export/export_mesh.h"
#include "nodes/export/export_points.h"
#include "nodes/export/export_wav.h"
#include "tests/nodes/export/test_head.h"
#include "tests/support/expect_throw_text.h"

namespace face::exports {
namespace {

using decode::LengthUnit;

engine::Seq<MeshPoints> two_frames() {
  return engine::Seq<MeshPoints>({MeshPoints{{{0, 0, 0}, {100, 0, 0}, {0, 200.0625f, 0}}},
                                  MeshPoints{{{0, 0, 1}, {100, -0.5f, 0}, {0, 1.0f / 3, 0}}}});
}

void expect_equal(const engine::Seq<MeshPoints>& a, const engine::Seq<MeshPoints>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t f = 0; f < a.size(); ++f) EXPECT_EQ(a.at(f)->points_mm, b.at(f)->points_mm);
}

Timeline at_25_hz(std::size_t frames) {
  Timeline timeline;
  for (std::size_t f = 0; f < frames; ++f) timeline.time_s.push_back(static_cast<double>(f) / 25);
  timeline.duration_s = static_cast<double>(frames) / 25;
  return timeline;
}

TEST(ExportObj, IsReadBackBitForBit) {
  const Mesh mesh = test::square_rig().neutral;
  const engine::File file = export_obj(mesh, nullptr, {ExportUnit::mm});
  EXPECT_EQ(file.suffix(), ".obj");
  const Mesh back = decode::read_mesh(file, {LengthUnit::mm}).mesh;
  EXPECT_EQ(back.points_mm, mesh.points_mm);
  EXPECT_EQ(back.corners, mesh.corners);
  EXPECT_EQ(back.polygon_starts, mesh.polygon_starts);
  EXPECT_EQ(back.uvs, mesh.uvs);
  EXPECT_EQ(back.corner_uvs, mesh.corner_uvs);
  ASSERT_EQ(back.parts.size(), 2u);
  EXPECT_EQ(back.parts[1].name, "lashes");
  EXPECT_EQ(back.parts[1].first_polygon, 1u);
}

TEST(ExportObj, WritesAFrameInMetres) {
  Mesh mesh;
  mesh.points_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2};
  mesh.polygon_starts = {0, 3};
  const MeshPoints frame{{{0, 0, 500}, {250, 0, 0}, {0, -2, 0}}};
  EXPECT_EQ(export_obj(mesh, &frame).bytes(), "# Facegraph\nv 0 0 0.5\nv 0.25 0 0\nv 0 -0.002 0\nf 1 2 3\n");
}

TEST(ExportPly, IsReadBackBitForBit) {
  const Mesh mesh = test::square_rig().neutral;
  const Mesh back = decode::read_mesh(export_ply(mesh, nullptr, {ExportUnit::mm}), {LengthUnit::mm}).mesh;
  EXPECT_EQ(back.points_mm, mesh.points_mm);
  EXPECT_EQ(back.corners, mesh.corners);
  EXPECT_EQ(back.polygon_starts, mesh.polygon_starts);
  ASSERT_EQ(back.colors_srgb.size(), 6u);
  EXPECT_NEAR(back.colors_srgb[0][1], 0.5f, 0.501 / 255);
}

TEST(ExportMesh, RefusesWhatDoesNotFit) {
  Mesh mesh = test::square_rig().neutral;
  const MeshPoints few{{{0, 0, 0}}};
  EXPECT_THROW_TEXT(export_obj(mesh, &few), "points has 1 vertices, the mesh has 6");
  mesh.points_mm[2][1] = std::numeric_limits<float>::infinity();
  EXPECT_THROW_TEXT(export_ply(mesh, nullptr), "vertex 2 is at (10, inf, 0), expected finite numbers");
  mesh.points_mm.pop_back();
  mesh.colors_srgb.clear();
  EXPECT_THROW_TEXT(export_ply(mesh, nullptr), "a polygon has vertex 5, but the mesh has 5");
}

TEST(ExportPointsNpy, IsReadBackBitForBit) {
  const engine::File file = export_points_npy(two_frames(), {ExportUnit::mm});
  EXPECT_NE(file.bytes().find("'shape': (2, 3, 3)"), std::string::npos);
  expect_equal(decode::read_points(file, {LengthUnit::mm}), two_frames());
}

TEST(ExportPc2, IsReadBackBitForBit) {
  const engine::File file = export_pc2(two_frames(), {ExportUnit::mm});
  EXPECT_EQ(file.bytes().size(), 32u + 2 * 3 * 12);
  EXPECT_EQ(file.bytes().substr(0, 12), std::string("POINTCACHE2\0", 12));
  expect_equal(decode::read_points(file, {LengthUnit::mm}), two_frames());
  // In metres the unit is told by the size: 0.2 of them is a head.
  EXPECT_NEAR(decode::read_points(export_pc2(two_frames())).at(0)->points_mm[2][1], 200.0625f, 1e-4);
}

TEST(ExportPoints, RefusesNothingAndFramesOfAnotherMesh) {
  EXPECT_THROW_TEXT(export_pc2({}), "there are no frames to export");
  EXPECT_THROW_TEXT(export_points_npy(engine::Seq<MeshPoints>({MeshPoints{{{0, 0, 0}}}, MeshPoints{}})),
                    "frame 1 has 0 vertices, the first has 1");
}

TEST(ReadPoints, RefusesAPointCacheThatIsCutOff) {
  std::string bytes = export_pc2(two_frames()).bytes();
  bytes.pop_back();
  EXPECT_THROW_TEXT(decode::read_points(engine::File::from_bytes(bytes, ".pc2")),
                    "the data: has 103 bytes, expected 104 for 2 frames of 3 vertices");
  EXPECT_THROW_TEXT(
      decode::read_points(engine::File::from_bytes("x", ".abc")),
      "the data: found the suffix \".abc\", expected .npy or .pc2; meshes of one frame each (PLY, OBJ) are "
      "read by decode.mesh");
}

TEST(ExportUsda, WritesTimeSamples) {
  Mesh mesh;
  mesh.points_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.corners = {0, 1, 2};
  mesh.polygon_starts = {0, 3};
  mesh.uvs = {{0, 0}, {1, 0}, {0, 0.5f}};
  mesh.corner_uvs = {0, 1, 2};
  mesh.parts = {{.name = "skin left", .first_polygon = 0, .polygon_count = 1}};
  EXPECT_EQ(export_usda(mesh, two_frames(), at_25_hz(2)).bytes(), R"(#usda 1.0
(
    defaultPrim = "head"
    metersPerUnit = 0.001
    upAxis = "Y"
    startTimeCode = 0
    endTimeCode = 1
    timeCodesPerSecond = 25
    framesPerSecond = 25
)

def Xform "head"
{
    def Mesh "mesh"
    {
        uniform token subdivisionScheme = "none"
        int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        texCoord2f[] primvars:st = [(0.000000, 0.000000), (1.000000, 0.000000), (0.000000, 0.500000)] (
            interpolation = "faceVarying"
        )
        point3f[] points.timeSamples = {
            0: [(0.000, 0.000, 0.000), (100.000, 0.000, 0.000), (0.000, 200.062, 0.000)],
            1: [(0.000, 0.000, 1.000), (100.000, -0.500, 0.000), (0.000, 0.333, 0.000)],
        }
        float3[] extent.timeSamples = {
            0: [(0.000, 0.000, 0.000), (100.000, 200.062, 0.000)],
            1: [(0.000, -0.500, 0.000), (100.000, 0.333, 1.000)],
        }

        def GeomSubset "skin_left_0"
        {
            uniform token elementType = "face"
            uniform token familyName = "materialBind"
            int[] indices = [0]
        }
    }
}
)");
}

TEST(ExportUsda, KeepsWholeTimeCodesAtOddRates) {
  Mesh mesh;
  mesh.points_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const MeshPoints still{mesh.points_mm};
  Timeline timeline;
  for (int f = 0; f < 3; ++f) timeline.time_s.push_back(f / 29.97);
  timeline.duration_s = 3 / 29.97;
  const std::string text = export_usda(mesh, engine::Seq<MeshPoints>({still, still, still}), timeline).bytes();
  EXPECT_NE(text.find("timeCodesPerSecond = 29.97\n"), std::string::npos);
  EXPECT_NE(text.find("            2: [(0.000"), std::string::npos);
  EXPECT_THROW_TEXT(export_usda(mesh, two_frames(), at_25_hz(3)), "there are 2 frames, but the timeline has 3 times");
}

TEST(ExportWav, IsReadBackToHalfAStep) {
  Audio audio{16000, {}};
  for (int i = 0; i < 1600; ++i) audio.samples.push_back(static_cast<float>(0.8 * std::sin(0.05 * i)));
  const engine::File file = export_wav(audio);
  const std::string path = testing::TempDir() + "/export_wav.wav";
  std::ofstream(path, std::ios::binary) << file.bytes();
  const Audio back = decode::read_audio(engine::File::at(path), {}).audio;
  ASSERT_EQ(back.samples.size(), audio.samples.size());
  for (std::size_t i = 0; i < audio.samples.size(); ++i) EXPECT_NEAR(back.samples[i], audio.samples[i], 0.501 / 32768);
  EXPECT_THROW_TEXT(export_wav({16000, {0, std::numeric_limits<float>::quiet_NaN()}}),
                    "sample 1 is nan, expected a finite number");
  EXPECT_THROW_TEXT(export_wav({0, {}}), "the recording has 0 samples per second, expected 1 or more");
}

TEST(ExportWav, ClipsAndBeginsAsWavDoes) {
  const std::string bytes = export_wav({8000, {2, -2}}).bytes();
  ASSERT_EQ(bytes.size(), 48u);
  EXPECT_EQ(bytes.substr(0, 4) + bytes.substr(8, 8), "RIFFWAVEfmt ");
  EXPECT_EQ(bytes.substr(44), std::string("\xFF\x7F\x00\x80", 4));
}

TEST(ReadAnimation, GivesBackWhatAGlbWasWrittenWith) {
  const Rig rig = test::square_rig();
  Weights full;
  for (std::size_t s = 0; s < arkit_count; ++s) full.values.push_back(static_cast<float>(s) / 64.0f);
  const engine::Seq<Weights> frames({Weights{}, full});
  const auto back = decode::read_animation(export_gltf(rig, frames, at_25_hz(2)), nullptr);
  ASSERT_EQ(back.weights.size(), 2u);
  EXPECT_EQ(back.weights.at(1)->values, full.values);
  EXPECT_EQ(back.weights.at(0)->values, std::vector<float>(arkit_count, 0.0f));
  EXPECT_NEAR(back.timeline.time_s[1], 0.04, 1e-7);
  EXPECT_NEAR(back.timeline.duration_s, 0.08, 1e-7);
}

TEST(ReadAnimation, GivesBackWhatALiveLinkTableWasWrittenWith) {
  Weights open;
  open.values.assign(arkit_count, 0.0f);
  open.values[arkit_index("jawOpen")] = 0.75f;
  const engine::File file = export_live_link_csv(engine::Seq<Weights>({Weights{}, open}), at_25_hz(2));
  const auto back = decode::read_animation(file, nullptr);
  ASSERT_EQ(back.weights.size(), 2u);
  EXPECT_EQ(back.weights.at(1)->values, open.values);
  EXPECT_NEAR(back.timeline.time_s[1], 0.04, 1e-4);
}

TEST(ReadAnimation, SaysWhatIsWrongWithAFile) {
  const auto csv = [](const std::string& text) {
    return decode::read_animation(engine::File::from_bytes(text, ".csv"), nullptr);
  };
  EXPECT_THROW_TEXT(
      csv("Timecode,Nose\n00:00:00:00.0,1\n"),
      "the data: found no column with an ARKit name (EyeBlinkLeft, ...), expected a table of Live Link Face");
  EXPECT_THROW_TEXT(csv("Timecode,JawOpen\n00:00,1\n"),
                    "the data:2: found the timecode \"00:00\", expected hours:minutes:seconds:frames");
  EXPECT_THROW_TEXT(csv("Timecode,JawOpen\n00:00:01:00,1\n00:00:00:59,1\n"),
                    "the data: key 1 is at -0.0166667 s, expected later than the one before");
  EXPECT_THROW_TEXT(csv("Timecode,JawOpen\n00:00:01:00,\n"), "the data:2: JawOpen is empty, expected a number");
}

}  // namespace
}  // namespace face::exports
