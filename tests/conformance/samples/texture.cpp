// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"
#include "tests/conformance/samples/shared.h"

namespace conformance {
namespace {

// Narrower than the model's face, so that something is revealed beside it.
const Maker small_person = changed<face::Rig>(another("rig", 0), [](face::Rig& rig, int) {
  for (face::Vec3f& point : rig.neutral.points_mm) point[0] *= 0.8f;
});

// Faces of other sizes.
const Maker sized_model =
    changed<face::MorphableModel>(made_by("model.from_rig", "model"), [](face::MorphableModel& model, int variant) {
      for (face::Vec3f& point : model.mean.points_mm) point[0] *= 1 + 0.1f * static_cast<float>(variant);
    });

const Registered texture({
    .inputs =
        {
            {"texture.reveal_background.mask", disc},
            {"texture.continue_background.mask", disc},
            {"texture.reanimate.model", sized_model},
            {"texture.reanimate.background", another("image", 2)},
            {"texture.reanimate.person", small_person},
            {"texture.reanimate.weights", opening_mouth},
            {"texture.render_into.person", small_person},
            {"texture.render_into.weights", opening_mouth},
        },
    .params = {{"texture.extract.size_px", whole(64)}},
});

}  // namespace
}  // namespace conformance
