// SPDX-License-Identifier: Apache-2.0
// Nodes of decode that read what nodes of export write.
#include "nodes/types/matrix.h"
#include "tests/conformance/samples/area_samples.h"

namespace conformance {
namespace {

const std::string gltf_alone = "it counts for tables; tests/nodes/export/meshes_test.cpp reads one";

// A GLB of one triangle with this morph target.
std::string glb(const std::string& target) {
  const std::string json =
      R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes":
    {"POSITION": 0}, "targets": [{"POSITION": 0}]}], "extras": {"targetNames": [")" +
      target + R"("]}}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3,
    "type": "VEC3"}], "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36}]})";
  const std::string binary(36, '\0');
  const auto uint = [](std::size_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i));
    return bytes;
  };
  return "glTF" + uint(2) + uint(28 + json.size() + binary.size()) + uint(json.size()) + "JSON" + json +
         uint(binary.size()) + "BIN" + std::string(1, '\0') + binary;
}

const Registered formats({
    .inputs =
        {
            {"export.gltf.original", text_file(".glb", {glb("jawOpen"), glb("jawLeft")})},
            {"export.gltf.names",
             text_file(".json", {R"({"jawOpen": "jawOpen"})", R"({"jawOpen": "jawLeft", "jawLeft": "jawOpen"})"})},
            // A list, points, and integers.
            {"export.npy.matrix", made([](int variant) {
               return face::Matrix{1, 6, {1, 2, 3, 4, 5.0 + variant, 6}};
             })},
            {"decode.mesh.file", file_by("export.ply")},
            {"decode.points.file", file_by("export.pc2")},
            {"decode.table.file", file_by("export.table")},
            {"decode.animation.file", file_by("export.gltf")},
            {"decode.animation.names",
             text_file(".json", {R"({"jawOpen": "jawOpen"})", R"({"jawOpen": "jawLeft", "jawLeft": "jawOpen"})"})},
            {"decode.check_rig.file", file_by("export.gltf")},
            {"decode.check_rig.names",
             text_file(".json", {R"({"jawOpen": "jawOpen"})", R"({"jawOpen": "jawLeft", "jawLeft": "jawOpen"})"})},
        },
    .shown_elsewhere = {{"decode.animation.timecode_rate_hz", gltf_alone}},
});

}  // namespace
}  // namespace conformance
