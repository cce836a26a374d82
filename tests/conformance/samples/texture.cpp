// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "nodes/types/matrix.h"
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

const Maker gains = made([](int variant) {
  return face::Matrix{1, 3, {1.1, 1.2, 1.3 + 0.1 * static_cast<double>(variant)}};
});
const std::string no_teeth = "of 64 x 48 pixels teeth are less than one (MeasureTeeth tests)";

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
            {"texture.reanimate.teeth", gains},
            {"texture.render_into.teeth", gains},
        },
    .params = {{"texture.extract.size_px", whole(64)}},
    .shown_elsewhere = {{"texture.reanimate.teeth", no_teeth},
                        {"texture.render_into.teeth", no_teeth},
                        {"texture.measure_teeth.model", no_teeth},
                        {"texture.measure_teeth.person", no_teeth},
                        {"texture.measure_teeth.albedo", no_teeth},
                        {"texture.measure_teeth.fit", no_teeth},
                        {"texture.measure_teeth.picture", no_teeth}},
});

}  // namespace
}  // namespace conformance
