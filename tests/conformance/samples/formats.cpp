// SPDX-License-Identifier: Apache-2.0
// Nodes of decode that read what nodes of export write.
#include "nodes/types/matrix.h"
#include "tests/conformance/samples/area_samples.h"

namespace conformance {
namespace {

const std::string gltf_alone = "it counts for tables; tests/nodes/export/meshes_test.cpp reads one";

const Registered formats({
    .inputs =
        {
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
