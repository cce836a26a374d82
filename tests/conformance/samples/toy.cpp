// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/samples/area_samples.h"

namespace conformance {
namespace {

const Registered toy({
    .params =
        {
            {"toy.blob.size_mb", 0.001},
            {"toy.cheap_blob.size_mb", 0.001},
            {"toy.blob_film.size_mb", 0.001},
            {"toy.blob_film.count", whole(3)},
            {"toy.blob_film.seconds", 0.001},
            {"toy.blob_size.seconds", 0.0},
            {"toy.sleep.seconds", 0.01},
            {"toy.slow_read.seconds", 0.01},
            {"toy.fail.when", text("nothing of the kind")},
            {"toy.contains.part", text("Bob")},
            {"toy.count_up.count", whole(5)},
        },
    .values = {{"toy.fail.when", {text("Bob")}}},
    .only_refuses = {{"toy.fail.when", "it is what the node fails at"}},
    // `facegraph cache audit` finds it in tests, and so do these rules.
    .sins = {{"toy.unsteady", {"toy.unsteady: result: same result twice: the second differs"}}},
});

}  // namespace
}  // namespace conformance
