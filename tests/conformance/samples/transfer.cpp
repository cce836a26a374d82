// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/samples/area_samples.h"

namespace conformance {
namespace {

const std::string belong_together =
    "its inputs belong to one head, whose mouth is open; tests/nodes/transfer/parts_test.cpp has one";

const Registered transfer({
    .without_sample =
        {
            {"transfer.project_cylinder", belong_together},
            {"transfer.fit_identity", belong_together},
            {"transfer.look_up", belong_together},
            {"transfer.resample", belong_together},
            {"transfer.resample_colours", belong_together},
            {"transfer.resample_scan", belong_together},
            {"transfer.scan_places", belong_together},
            {"transfer.rest_shape", "its frames are as many as its timeline's; tests/nodes/transfer/parts_test.cpp"},
            {"transfer.move_model", belong_together},
            {"transfer.rest_model", belong_together},
            {"transfer.freeze_edges", belong_together},
            {"transfer.mark_lips", belong_together},
            {"transfer.judge_lips", belong_together},
            {"transfer.pick_truth", "its frame is the id of one of its maps; tests/nodes/transfer/parts_test.cpp"},
        },
});

}  // namespace
}  // namespace conformance
