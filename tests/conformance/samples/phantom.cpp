// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "nodes/types/rig.h"
#include "tests/conformance/samples/shared.h"

namespace conformance {
namespace {

// With more shapes of its own from variant to variant.
const Maker larger_rig = changed<face::Rig>(another("rig", 0), [](face::Rig& rig, int variant) {
  for (int s = 0; s < variant; ++s) rig.shapes.push_back({"own_" + std::to_string(s), {}, {}});
});

const Registered phantom({
    .inputs =
        {
            // A projector stands beside its camera.
            {"phantom.scan_frame.projector", another("camera", 12)},
            {"phantom.lose_points.projector", another("camera", 12)},
            {"phantom.pattern_images.projector", another("camera", 12)},
            {"phantom.make_view.rig", larger_rig},
            {"phantom.mark_points.exact", two_digit_points},
            {"phantom.read_configurations.file",
             text_file(".json", {R"({"open": {"jawOpen": 0.5}})", R"({"open": {"jawOpen": 0.7}})"})},
        },
    .params =
        {
            {"phantom.video_frame.width_px", whole(64)},
            {"phantom.video_frame.height_px", whole(48)},
            {"phantom.pattern_images.width_px", whole(64)},
            {"phantom.pattern_images.height_px", whole(48)},
            {"phantom.pattern_images.projector_width_px", whole(64)},
            {"phantom.pattern_images.projector_height_px", whole(48)},
            {"phantom.pattern_images.fine_periods", whole(8)},
            {"phantom.pattern_images.coarse_periods", whole(1)},
            {"phantom.lose_points.share", 0.5},
            {"phantom.lose_points.width_px", whole(64)},
            {"phantom.lose_points.height_px", whole(48)},
            {"phantom.lose_points.projector_width_px", whole(64)},
            {"phantom.lose_points.projector_height_px", whole(48)},
        },
    .settings = {{"phantom.perform", {{{"turn_deg", 40.0}}}}},
});

}  // namespace
}  // namespace conformance
