// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "nodes/types/matrix.h"
#include "nodes/types/mesh.h"
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

const Registered meshik({
    .inputs =
        {
            {"meshik.reconstruct.weights", few_weights},
            {"meshik.blend_linear.weights", few_weights},
            {"meshik.transfer_landmarks.weights", few_weights},
            {"meshik.transfer_landmarks.key_shapes", speaker_keys},
            {"meshik.sculpt_keys.key_shapes", speaker_keys},
            {"meshik.sculpt_keys.neutral", speaker_points},
            {"meshik.solve.start", few_weights},
            {"meshik.reconstruct_matrix.reference", matrices(4, 3)},
            {"meshik.reconstruct_matrix.examples", matrices(4, 12)},
            {"meshik.reconstruct_matrix.faces", faces},
        },
    .types = {{"mesh_space", made_by("meshik.prepare", "space")}},
});

}  // namespace
}  // namespace conformance
