// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/samples/area_samples.h"

namespace conformance {
namespace {

const Registered toy({
    .params =
        {
            {"toy.blob.size_mb", 0.001},
            {"toy.cheap_blob.size_mb", 0.001},
            {"toy.blob_size.seconds", 0.0},
            {"toy.fail.when", text("nothing of the kind")},
            {"toy.contains.part", text("Bob")},
            {"toy.count_up.count", whole(5)},
        },
    .values = {{"toy.fail.when", {text("Bob")}}},
    .without_sample =
        {
            {"toy.unsteady", "it is the bad example that `facegraph cache audit` finds in tests"},
            {"toy.slow_read", "it only waits while it reads, for tests of files that change"},
            {"toy.sleep", "it only waits"},
        },
});

}  // namespace
}  // namespace conformance
