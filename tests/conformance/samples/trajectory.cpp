// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/phone_statistics.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"
#include "tests/conformance/samples/area_samples.h"
#include "tests/support/samples.h"
#include "tests/support/toy_run.h"

namespace conformance {
namespace {

// Frames that are so far apart that a face blinks in some of them.
const Maker slow_timeline = made([](int variant) {
  face::Timeline timeline;
  const double step = 0.31 + 0.07 * variant;
  for (int f = 0; f < 40; ++f) timeline.time_s.push_back(step * f);
  timeline.duration_s = 40 * step;
  return timeline;
});

const Maker quiet_weights = changed<face::Weights>(another("weights", 0), [](face::Weights& weights, int) {
  for (float& value : weights.values) value *= 0.2f;
});

// The shipped table; in its variants another first target.
Sample viseme_table(engine::Plugins&, int variant) {
  std::string table = test::read_file(FACEGRAPH_SOURCE_DIR "/graphs/speech/visemes.json");
  const std::size_t digit = table.find("0.", table.find("\"weights\"")) + 2;
  if (variant > 0) table[digit] = static_cast<char>('1' + variant);
  return {test::sample_file("visemes" + std::to_string(variant) + ".json", table), "file"};
}

// A speaker whose parameters move together.
const Maker linked_statistics =
    changed<face::PhoneStatistics>(another("phone_statistics", 0), [](face::PhoneStatistics& statistics, int) {
      for (face::PhoneStatistic& phone : statistics.phones) phone.covariance[1] = phone.covariance[4] = 0.5;
    });

const Registered trajectory({
    .inputs =
        {
            {"trajectory.read_visemes.file", viseme_table},
            {"trajectory.add_idle.timeline", slow_timeline},
            {"trajectory.add_idle.weights", quiet_weights},
            {"trajectory.gaussian_path.variances", matrices(6, 4)},
            {"trajectory.speak_gaussian.statistics", linked_statistics},
        },
    .lengths = {{"trajectory.add_idle.weights", 40}},
});

}  // namespace
}  // namespace conformance
