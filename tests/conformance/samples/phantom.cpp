// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/samples/area_samples.h"

namespace conformance {
namespace {

const Registered phantom({
    .inputs =
        {
            // A projector stands beside its camera.
            {"phantom.scan_frame.projector", another("camera", 12)},
            {"phantom.lose_points.projector", another("camera", 12)},
            {"phantom.pattern_images.projector", another("camera", 12)},
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
