// SPDX-License-Identifier: Apache-2.0
// Heads packed by meshoptimizer and Draco are those that were packed.
#include "nodes/decode/gltf_compression.h"

#include <draco/compression/encode.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "nodes/decode/glb.h"
#include "nodes/decode/read_rig.h"
#include "nodes/types/arkit.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::decode;
using nlohmann::json;

namespace {

constexpr std::size_t side = 12, count = side * side;

// A bent sheet in metres, and what a jaw does to it.
struct Sheet {
  std::vector<float> positions, offsets;
  std::vector<std::uint32_t> corners;
};

Sheet sheet() {
  Sheet s;
  for (std::size_t y = 0; y < side; ++y)
    for (std::size_t x = 0; x < side; ++x) {
      const float u = 0.01f * static_cast<float>(x), v = 0.01f * static_cast<float>(y);
      s.positions.insert(s.positions.end(), {u, v, 0.02f * std::sin(20 * u)});
      s.offsets.insert(s.offsets.end(), {0, y < side / 2 ? -0.01f : 0.0f, 0});
    }
  const auto at = [](std::size_t x, std::size_t y) { return static_cast<std::uint32_t>(y * side + x); };
  for (std::size_t y = 0; y + 1 < side; ++y)
    for (std::size_t x = 0; x + 1 < side; ++x)
      for (const std::uint32_t v : {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y), at(x + 1, y + 1), at(x, y + 1)})
        s.corners.push_back(v);
  return s;
}

// A head of the views 0 positions, 1 offsets and 2 indices.
json document_of(std::size_t corners) {
  json targets = json::array();
  const json names = {"jawOpen", "mouthClose", "mouthFunnel", "mouthPucker", "mouthRollLower", "mouthRollUpper"};
  for (std::size_t i = 0; i < names.size(); ++i) targets.push_back({{"POSITION", 1}});
  return {{"asset", {{"version", "2.0"}}},
          {"scene", 0},
          {"scenes", {{{"nodes", {0}}}}},
          {"nodes", {{{"mesh", 0}}}},
          {"meshes",
           {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 2}, {"targets", targets}}}},
             {"extras", {{"targetNames", names}}}}}},
          {"accessors",
           {{{"bufferView", 0},
             {"componentType", 5126},
             {"count", count},
             {"type", "VEC3"},
             {"min", {0, 0, -1}},
             {"max", {1, 1, 1}}},
            {{"bufferView", 1}, {"componentType", 5126}, {"count", count}, {"type", "VEC3"}},
            {{"bufferView", 2}, {"componentType", 5125}, {"count", corners}, {"type", "SCALAR"}}}},
          {"bufferViews", json::array()},
          {"buffers", {json::object()}}};
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

json add(std::string& binary, const std::string& bytes) {
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  binary += bytes;
  return {{"buffer", 0}, {"byteOffset", binary.size() - bytes.size()}, {"byteLength", bytes.size()}};
}

Rig read(const json& document, const std::string& binary) {
  return read_rig(engine::File::from_bytes(glb_bytes(document, binary), ".glb"), nullptr);
}

Rig plain() {
  const Sheet s = sheet();
  json document = document_of(s.corners.size());
  std::string binary;
  document["bufferViews"] = {add(binary, bytes_of(s.positions)), add(binary, bytes_of(s.offsets)),
                             add(binary, bytes_of(s.corners))};
  return read(document, binary);
}

// A view that lies in no buffer but the one that nobody has, as gltfpack writes it.
json packed_view(json place, std::size_t rows, std::size_t stride, const char* mode) {
  place["byteStride"] = stride;
  place["count"] = rows;
  place["mode"] = mode;
  return {{"buffer", 1},
          {"byteOffset", 0},
          {"byteLength", rows * stride},
          {"extensions", {{"EXT_meshopt_compression", std::move(place)}}}};
}

std::string packed_vertices(const std::vector<float>& values) {
  std::string out(meshopt_encodeVertexBufferBound(count, 12), '\0');
  out.resize(
      meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(), values.data(), count, 12));
  return out;
}

// The document of a head packed by meshoptimizer, and its bytes.
json packed_by_meshopt(std::string& binary) {
  const Sheet s = sheet();
  json document = document_of(s.corners.size());
  std::string corners(meshopt_encodeIndexBufferBound(s.corners.size(), count), '\0');
  corners.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(corners.data()), corners.size(),
                                           s.corners.data(), s.corners.size()));
  document["bufferViews"] = {packed_view(add(binary, packed_vertices(s.positions)), count, 12, "ATTRIBUTES"),
                             packed_view(add(binary, packed_vertices(s.offsets)), count, 12, "ATTRIBUTES"),
                             packed_view(add(binary, corners), s.corners.size(), 4, "TRIANGLES")};
  document["buffers"].push_back(
      {{"byteLength", 1 << 16}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  document["extensionsUsed"] = document["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  return document;
}

// The same of a head whose vertices and triangles Draco packed, its shapes as they are.
json packed_by_draco(std::string& binary) {
  const Sheet s = sheet();
  draco::Mesh mesh;
  mesh.set_num_points(count);
  draco::GeometryAttribute position;
  position.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  const int id = mesh.AddAttribute(position, true, count);
  for (std::uint32_t v = 0; v < count; ++v)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), &s.positions[3 * v]);
  for (std::size_t f = 0; f < s.corners.size() / 3; ++f)
    mesh.AddFace({draco::PointIndex(s.corners[3 * f]), draco::PointIndex(s.corners[3 * f + 1]),
                  draco::PointIndex(s.corners[3 * f + 2])});
  draco::Encoder encoder;
  encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);  // vertices stay in the order of the shapes'
  draco::EncoderBuffer bytes;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &bytes).ok());
  json document = document_of(s.corners.size());
  document["bufferViews"] = {add(binary, {bytes.data(), bytes.size()}), add(binary, bytes_of(s.offsets))};
  for (const int i : {0, 2}) document["accessors"][static_cast<std::size_t>(i)].erase("bufferView");
  document["meshes"][0]["primitives"][0]["extensions"] = {
      {"KHR_draco_mesh_compression",
       {{"bufferView", 0}, {"attributes", {{"POSITION", mesh.attribute(id)->unique_id()}}}}}};
  document["extensionsUsed"] = document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return document;
}

// Triangles from their lowest corner on: packing turns them.
std::vector<std::uint32_t> from_lowest(std::vector<std::uint32_t> corners) {
  for (auto c = corners.begin(); c != corners.end(); c += 3) std::rotate(c, std::min_element(c, c + 3), c + 3);
  return corners;
}

void expect_same(const Rig& found, const Rig& expected) {
  EXPECT_EQ(from_lowest(found.neutral.corners), from_lowest(expected.neutral.corners));
  ASSERT_EQ(found.neutral.points_mm.size(), expected.neutral.points_mm.size());
  for (std::size_t v = 0; v < count; ++v)
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_NEAR(found.neutral.points_mm[v][c], expected.neutral.points_mm[v][c], 1e-4) << v;
  const Shape &a = found.shapes[arkit_index("jawOpen")], &b = expected.shapes[arkit_index("jawOpen")];
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.offsets_mm, b.offsets_mm);
}

}  // namespace

TEST(GltfCompression, OfMeshoptIsUndone) {
  std::string binary;
  const json document = packed_by_meshopt(binary);
  expect_same(read(document, binary), plain());
}

TEST(GltfCompression, OfDracoIsUndone) {
  std::string binary;
  const json document = packed_by_draco(binary);
  expect_same(read(document, binary), plain());
}

TEST(GltfCompression, OfDracoStatesTheBoundsOfWhatIsUnpacked) {
  std::string binary;
  json document = packed_by_draco(binary);
  undo_compression(document, binary, "head.glb");
  const json& accessor = document["accessors"][0];
  EXPECT_NEAR(accessor["max"][0].get<float>(), 0.11f, 1e-6f);
  EXPECT_NEAR(accessor["min"][1].get<float>(), 0.0f, 1e-6f);
  EXPECT_EQ(document["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteStride"], 12);
}

TEST(GltfCompression, LeavesAPlainFile) {
  std::string binary;
  json document = packed_by_meshopt(binary);
  document["buffers"] = {json::object()};
  undo_compression(document, binary, "head.glb");
  EXPECT_EQ(document.dump().find("EXT_meshopt_compression"), std::string::npos);
  EXPECT_EQ(document["extensionsRequired"], json({"KHR_mesh_quantization"}));
  EXPECT_EQ(document["bufferViews"][0]["buffer"], 0);
  const std::size_t begin = document["bufferViews"][0]["byteOffset"], size = document["bufferViews"][0]["byteLength"];
  EXPECT_EQ(binary.substr(begin, size), bytes_of(sheet().positions));
}

TEST(GltfCompression, OfDamagedBytesIsNamed) {
  const auto damaged = [](json (*make)(std::string&), const auto& change) {
    std::string binary;
    json document = make(binary);
    change(document, binary);
    return read(document, binary);
  };
  const auto packed = [](json& document, std::size_t view) -> json& {
    return document["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
  };
  EXPECT_THROW_TEXT(damaged(packed_by_meshopt, [](json&, std::string& binary) { binary[0] = 'x'; }),
                    "the data buffer view 0: its " + std::to_string(packed_vertices(sheet().positions).size()) +
                        " packed bytes are damaged, or of a version that is not read");
  EXPECT_THROW_TEXT(damaged(packed_by_meshopt, [&](json& d, std::string&) { packed(d, 1)["byteLength"] = 1000000; }),
                    "the data buffer view 1: reaches byte " + std::to_string([&] {
                      std::string binary;
                      json d = packed_by_meshopt(binary);
                      return packed(d, 1)["byteOffset"].get<std::size_t>() + 1000000;
                    }()) +
                        ", its buffer has " + std::to_string([] {
                          std::string binary;
                          packed_by_meshopt(binary);
                          return (binary.size() + 3) / 4 * 4 + 12 * count;  // view 0 stands there already
                        }()));
  EXPECT_THROW_TEXT(damaged(packed_by_meshopt, [&](json& d, std::string&) { packed(d, 0)["mode"] = "CUBES"; }),
                    "the data buffer view 0: is packed as \"CUBES\", expected \"ATTRIBUTES\", \"TRIANGLES\" or "
                    "\"INDICES\"");
  EXPECT_THROW_TEXT(damaged(packed_by_meshopt, [&](json& d, std::string&) { packed(d, 0)["byteStride"] = 10; }),
                    "the data buffer view 0: has rows of 10 bytes, expected a multiple of 4");
  EXPECT_THROW_TEXT(damaged(packed_by_meshopt, [&](json& d, std::string&) { packed(d, 0)["filter"] = "QUATERNION"; }),
                    "the data buffer view 0: has the filter \"QUATERNION\" on rows of 12 bytes, expected \"NONE\", "
                    "\"OCTAHEDRAL\" (4 or 8 bytes), \"QUATERNION\" (8) or \"EXPONENTIAL\"");
  EXPECT_THROW_TEXT(damaged(packed_by_draco, [](json&, std::string& binary) { binary[0] = 'x'; }),
                    "the data mesh 0: its Draco bytes are damaged: Not a Draco file.");
  EXPECT_THROW_TEXT(
      damaged(packed_by_draco,
              [](json& d, std::string&) {
                d["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"] = {
                    {"POSITION", 7}};
              }),
      "the data mesh 0: its Draco bytes hold no POSITION");
}
