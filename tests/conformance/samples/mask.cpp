// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/table.h"
#include "tests/conformance/samples/shared.h"

namespace conformance {
namespace {

// What mask.remove_mouth reports; from frame to frame less alike.
const Maker areas = made([](int variant) {
  const double area = 60 + 8 * variant * variant;
  return face::Table{{"threshold_mm", "area_px", "area_low_px", "area_high_px", "proposed_mm"},
                     {{"frame", {6.5, area, 1.2 * area, 0.9 * area, 5.5}}}};
});

const Registered mask({
    .inputs =
        {
            {"mask.reopen.interior", grey_picture},
            {"mask.smooth_depth.where", grey_picture},
            {"mask.review.interiors", disc},
            {"mask.review.reports", areas},
        },
    .params = {{"mask.fill_holes.longest_px", whole(8)}, {"mask.fill_holes.largest_step_mm", 12.0}},
});

}  // namespace
}  // namespace conformance
