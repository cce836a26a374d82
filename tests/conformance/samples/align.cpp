// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/depth_scan.h"
#include "nodes/types/landmarks.h"
#include "tests/conformance/samples/shared.h"

namespace conformance {
namespace {

// Other names for other places, and one that no marker is near.
const Maker linked =
    changed<face::Landmarks>(scattered(another("landmarks", 0), 5), [](face::Landmarks& landmarks, int variant) {
      for (face::Landmark& point : landmarks.points) point.name = std::string(1, "abcd"[variant % 4]) + point.name;
      landmarks.points.back().y_px += 14 + variant;
    });

// The scan before, of a noisier camera.
const Maker grainy_scan = changed<face::DepthScan>(another("depth_scan", 2), [](face::DepthScan& scan, int) {
  for (std::size_t i = 0; i < scan.picture.pixels.size(); ++i) scan.picture.pixels[i] ^= i * i % 13;
});

const std::string a_stream = "it takes a head that turns, six markers in four frames (CheckCamera tests)";
const std::string as_the_mask = "it says what the mask was made with, and others are refused";

const Registered align({
    .inputs =
        {
            {"align.common_cover.covers", grey_picture},
            {"align.choose_reference.interiors", disc},
            {"align.link_markers.reference", linked},
            {"align.orient.reference_markers", scattered(another("landmarks", 0), 0.1)},
            {"align.crop.mask", made_by("align.cover", "mask")},
        },
    .before = {{"align.track_markers.scan", grainy_scan}},
    .params = {{"align.cover.rows", whole(24)},
               {"align.cover.columns", whole(32)},
               {"align.cover.step_mm", 8.0},
               {"align.crop.rows", whole(24)},
               {"align.crop.columns", whole(32)},
               {"align.crop.step_mm", 8.0}},
    .values = {{"align.choose_reference.frame", {text("0"), text("1"), text("2")}}},
    .shown_elsewhere = {{"align.choose_reference.odd", "it takes a face whose eyes shut (ChooseReference tests)"},
                        {"align.check_camera.scans", a_stream},
                        {"align.check_camera.markers", a_stream},
                        {"align.check_camera.reference", a_stream},
                        {"align.check_camera.reference_markers", a_stream},
                        {"align.check_camera.frames", a_stream}},
    .only_refuses = {{"align.crop.rows", as_the_mask}, {"align.crop.columns", as_the_mask}},
});

}  // namespace
}  // namespace conformance
