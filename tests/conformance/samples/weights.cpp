// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/samples/shared.h"

namespace conformance {
namespace {

const Registered weights({
    .inputs =
        {
            {"weights.nnls.targets", matrices(3, 6)},
            {"weights.nnls.neutral", matrices(1, 6)},
            {"weights.least_squares.targets", matrices(3, 6)},
            {"weights.least_squares.neutral", matrices(1, 6)},
            {"weights.fit_key_shapes.tracks", losing_points(another("landmarks", 0))},
        },
});

}  // namespace
}  // namespace conformance
