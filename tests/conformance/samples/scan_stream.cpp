// SPDX-License-Identifier: Apache-2.0
// Nodes of several areas that read, write and judge recorded streams of scans.
#include "tests/conformance/samples/shared.h"

namespace conformance {
namespace {

const std::string open_mouths =
    "the samples' mouths are open all the time; tests/nodes/evaluate/mesh_lip_gap_test.cpp has one that shuts";

const Registered scan_stream({
    .inputs = {{"evaluate.mesh_lip_gap.truth", another("mesh_points")},
               {"evaluate.mesh_lip_gap.timeline", spread_timeline}},
    .params = {{"model.measure_leakage.components", whole(1)}},
    .values = {{"model.measure_leakage.shape", {text("jawOpen")}}},
    .shown_elsewhere = {{"evaluate.mesh_lip_gap.rig", open_mouths},
                        {"evaluate.mesh_lip_gap.phones", open_mouths},
                        {"evaluate.mesh_lip_gap.timeline", open_mouths}},
});

}  // namespace
}  // namespace conformance
