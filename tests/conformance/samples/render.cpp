// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/samples/shared.h"

namespace conformance {
namespace {

const Registered render({
    .inputs = {{"render.contact_sheet.timeline", spread_timeline},
               {"render.landmarks_still.landmarks", scattered(another("landmarks", 0), 5)}},
    .params =
        {
            {"render.contact_sheet.pictures", whole(3)},
            {"render.contact_sheet.columns", whole(2)},
            {"render.contact_sheet.picture_px", whole(48)},
            {"render.shape_sheet.picture_px", whole(48)},
        },
});

}  // namespace
}  // namespace conformance
