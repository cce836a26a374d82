// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "nodes/types/image.h"
#include "nodes/types/matrix.h"
#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"
#include "tests/conformance/samples/shared.h"
#include "tests/support/samples.h"

namespace conformance {
namespace {

// A head that moved by some pixels.
const Maker perspective = made([](int variant) {
  return face::Matrix{3, 3, {1, 0.01, 1.5 + variant, -0.01, 1, 2, 0, 1e-4, 1}};
});

// As many as a model of two pictures has.
const Maker parameters = made([](int variant) {
  face::Weights weights;
  for (int k = 0; k < 4; ++k)
    weights.values.push_back(0.5f + 0.2f * static_cast<float>(std::sin(1.9 * variant + k * (2 + variant))));
  return weights;
});

// A video that ends with the phones; variants end later.
Sample spoken_timeline(engine::Plugins& plugins, int variant) {
  auto timeline = value_of<face::Timeline>(another("timeline", 0), plugins, variant);
  timeline.duration_s = value_of<face::Phones>(another("phones", 0), plugins, 0).duration_s + 0.5 * variant;
  return held(timeline);
}

// Of as many phones as the labels have; variants are heard elsewhere.
Sample phone_distances(engine::Plugins& plugins, int variant) {
  const std::size_t count = value_of<face::Phones>(another("phones", 0), plugins, 0).phones.size();
  return held(face::Matrix{count, 1, std::vector<double>(count, 0.5 * variant)});
}

Sample turned_points(engine::Plugins& plugins, int variant) { return two_digit_points(plugins, variant + 3); }

Sample moved_speaker(engine::Plugins& plugins, int variant) { return speaker_points(plugins, variant + 3); }

// Towards the viewer, of as many points as two_digit_points has.
const Maker point_depths = made([](int variant) {
  face::Matrix depths{68, 1, {}};
  for (int i = 0; i < 68; ++i) depths.values.push_back((3 + variant) * std::cos(0.5 * i));
  return depths;
});

const Maker mouth_picture = changed<face::Image>(another("image", 2), [](face::Image& image, int) {
  face::Image part{24, 16, 3, {}};
  for (int y = 0; y < part.height; ++y)
    for (int i = 0; i < 3 * part.width; ++i)
      part.pixels.push_back(image.pixels[static_cast<std::size_t>(3 * image.width * y + i)]);
  image = part;
});

const Registered mmm({
    .inputs =
        {
            {"mmm.scale_motion.reference", speaker_points},
            {"mmm.scale_motion.landmarks", moved_speaker},
            {"mmm.normalise.frame", another("image", 2)},
            {"mmm.analyse.image", another("image", 1)},
            {"mmm.paste.mouths", mouth_picture},
            {"mmm.head_mask.frame", sized_picture},
            {"mmm.head_mask.landmarks", two_digit_points},
            {"mmm.crop.landmarks", two_digit_points},
            {"mmm.paste.landmarks", two_digit_points},
            {"mmm.warp_perspective.perspective", perspective},
            {"mmm.read_opening.known_truth", two_digit_points},
            {"mmm.read_opening.truth", two_digit_points},
            {"mmm.settle_mouth.start", two_digit_points},
            {"mmm.settle_mouth.landmarks", turned_points},
            {"mmm.settle_mouth.depths_px", point_depths},
            {"mmm.build.exemplars", columns_of({{0, 2}, {1, 3}})},
            {"mmm.synthesise.parameters", parameters},
            {"mmm.add_grain.parameters", parameters},
            {"mmm.add_grain.image", made_by("mmm.synthesise", "image")},
            {"mmm.find_components.parameters", parameters},
            {"mmm.to_components.components", made_by("mmm.find_components", "components")},
            {"mmm.to_components.parameters", parameters},
            {"mmm.from_components.components", made_by("mmm.find_components", "components")},
            {"mmm.from_components.numbers", made_by("mmm.to_components", "numbers")},
            {"mmm.refine_speaker.weights", few_weights},
            {"mmm.refine_speaker.timeline", spread_timeline},
            {"mmm.check_labels.timeline", spoken_timeline},
            {"mmm.check_labels.apart_s", phone_distances},
        },
    .types = {{"mmm", made_by("mmm.build", "model")}},
    .params = {{"mmm.paste.left_px", whole(10)},
               {"mmm.paste.top_px", whole(20)},
               {"mmm.paste.feather_px", 4.0},
               {"mmm.crop.width_px", whole(32)},
               {"mmm.crop.height_px", whole(24)}},
    .values = {{"mmm.example_meshes.shapes", {std::vector<std::string>{"jawOpen"}}},
               {"mmm.read_opening.upper", {text("30"), text("51")}},
               {"mmm.read_opening.lower", {text("08"), text("57")}}},
    .only_refuses = {{"mmm.check_labels.timeline", "labels that do not end with it are refused, others given back"},
                     {"mmm.check_labels.apart_s", "labels that are heard elsewhere are refused, others given back"}},
});

}  // namespace
}  // namespace conformance
