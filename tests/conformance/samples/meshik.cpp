// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "nodes/types/key_shapes.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/rig.h"
#include "tests/conformance/samples/shared.h"
#include "tests/support/samples.h"

namespace conformance {
namespace {

// A tetrahedron's, of which the variants leave out another one.
const Maker faces = made([](int variant) {
  const std::vector<double> all = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0, 0, 1, 3};
  const auto from = static_cast<std::ptrdiff_t>(variant == 0 ? 0 : 3);
  return face::Matrix{4, 3, {all.begin() + from, all.begin() + from + 12}};
});

// Poses of which the upper half stands still.
const Maker half_still = changed<face::Mesh>(another("mesh", 0), [](face::Mesh& mesh, int variant) {
  const auto rest = *static_cast<const face::Mesh*>(test::sample("mesh", 0).get());
  for (std::size_t v = 0; v < mesh.points_mm.size(); ++v)
    if (rest.points_mm[v][1] > static_cast<float>(8 * variant)) mesh.points_mm[v] = rest.points_mm[v];
});

// What belongs to the head that meshik.simplify makes.
Sample simple_space(engine::Plugins& plugins, int variant) {
  if (!plugins.find("meshik.prepare")) return {};
  const auto rig = value_of<face::Rig>(made_by("meshik.simplify", "rig"), plugins, variant);
  PortValues inputs(2);
  inputs[0].value = held(rig.neutral).value;
  for (const Sample& example : sequence_by("meshik.simplify", "simple_examples")(plugins, variant))
    inputs[1].elements.push_back(example.value);
  const engine::NodeDeclaration& prepare = plugins.load("meshik.prepare");
  const Outcome outcome = call_node(prepare, inputs, defaults_of(prepare.info));
  return {outcome.values.at(0).at(0), "mesh_space"};
}
Sample simple_points(engine::Plugins& plugins, int variant) {
  face::MeshPoints points{value_of<face::Rig>(made_by("meshik.simplify", "rig"), plugins, 0).neutral.points_mm};
  for (face::Vec3f& point : points.points_mm) point[2] += 0.1f * point[1] * static_cast<float>(variant + 1);
  return held(points);
}

// A speaker's points with the jaw, lower in every variant; the same whose jaw and lower lip hang lower than in any.
void add_jaw(face::Landmarks& landmarks, double y_px) {
  landmarks.points.push_back({"jaw_r", 26, y_px - 1, true});
  landmarks.points.push_back({"chin", 32, y_px, true});
  landmarks.points.push_back({"jaw_l", 38, y_px - 1, true});
}
const Maker jaw_points = changed<face::Landmarks>(
    speaker_points, [](face::Landmarks& landmarks, int variant) { add_jaw(landmarks, 46 + 0.3 * variant); });
const Maker hanging_points = changed<face::Landmarks>(speaker_points, [](face::Landmarks& landmarks, int variant) {
  for (face::Landmark& point : landmarks.points)
    if (point.y_px > 32.5) point.y_px += 0.5 + 0.1 * variant;
  add_jaw(landmarks, 46.8 + 0.3 * variant);
});

// The same speaker with the middle of the inner lips, open in every other variant and key.
void add_inner_lips(face::Landmarks& landmarks, int variant) {
  landmarks.points.push_back({"inner_lip_2", 32, 31.5, true});
  landmarks.points.push_back({"inner_lip_6", 32, 32 + 0.8 * (variant % 2), true});
}
const Maker parted_points = changed<face::Landmarks>(speaker_points, add_inner_lips);
// Wider from one variant to the next.
const Maker spread_points = changed<face::Landmarks>(parted_points, [](face::Landmarks& landmarks, int variant) {
  for (face::Landmark& point : landmarks.points)
    if (point.name == "lip_6") point.x_px += 1 + 0.5 * variant;
});
const Maker parted_keys = changed<face::KeyShapes>(speaker_keys, [](face::KeyShapes& keys, int variant) {
  for (std::size_t k = 0; k < keys.shapes.size(); ++k)
    add_inner_lips(keys.shapes[k].landmarks, variant + static_cast<int>(k) + 1);
});

// How sure it is that the lips meet.
const Maker contact = made([](int variant) { return 0.25 * (variant % 4); });

const Registered meshik({
    .inputs =
        {
            {"meshik.reconstruct.weights", few_weights},
            {"meshik.blend_linear.weights", few_weights},
            {"meshik.transfer_landmarks.weights", few_weights},
            {"meshik.transfer_landmarks.key_shapes", parted_keys},
            {"meshik.transfer_landmarks.neutral", parted_points},
            {"meshik.transfer_landmarks.frame", spread_points},
            {"meshik.sculpt_keys.key_shapes", parted_keys},
            {"meshik.sculpt_keys.neutral", parted_points},
            {"meshik.transfer_landmarks.contact", contact},
            {"meshik.solve.start", few_weights},
            {"meshik.reconstruct_matrix.reference", matrices(4, 3)},
            {"meshik.reconstruct_matrix.examples", matrices(4, 12)},
            {"meshik.reconstruct_matrix.faces", faces},
            {"meshik.landmark_depths.neutral", speaker_points},
            {"meshik.raise_jaw.rest", hanging_points},
            {"meshik.raise_jaw.landmarks", losing_points(jaw_points)},
            {"meshik.still_vertices.examples", half_still},
            {"meshik.carry_fine.simple_space", simple_space},
            {"meshik.carry_fine.binding", made_by("meshik.simplify", "binding")},
            {"meshik.carry_fine.points", simple_points},
            {"meshik.carry_fine.weights", few_weights},
        },
    .types = {{"mesh_space", made_by("meshik.prepare", "space")}},
    .params = {{"meshik.simplify.vertices", whole(200)}},
    .values = {{"meshik.raise_jaw.highest_share", {0.95}},
               {"meshik.raise_jaw.most", {0.001}},
               {"meshik.raise_jaw.rest_frames", {std::int64_t{1}}}},
});

}  // namespace
}  // namespace conformance
