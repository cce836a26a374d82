// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "nodes/types/arkit.h"
#include "nodes/types/audio.h"
#include "nodes/types/camera.h"
#include "nodes/types/table.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"
#include "tests/conformance/samples/shared.h"

namespace conformance {
namespace {

// A row per frame of the timeline.
const Maker curves = made([](int variant) {
  face::Table table{{"own_mm", "truth_mm"}, {}};
  for (int f = 0; f < 4; ++f) table.rows.push_back({std::to_string(f), {std::sin(f + variant), std::cos(f)}});
  return table;
});

// A mouth that speaks, sooner and later than the truth.
face::Weights speaking(double phase) {
  face::Weights weights;
  weights.values.assign(face::arkit_count, 0.0f);
  weights.values[face::arkit_index("jawOpen")] = static_cast<float>(0.4 + 0.4 * std::sin(phase));
  weights.values[face::arkit_index("mouthStretchLeft")] = static_cast<float>(0.4 + 0.4 * std::cos(1.3 * phase));
  return weights;
}
const Maker speaking_mouth = made([](int variant) { return speaking(0.8 * variant + 0.9 * std::sin(0.37 * variant)); });
const Maker true_mouth = made([](int variant) { return speaking(0.8 * variant); });
const Maker long_timeline = made([](int variant) {
  face::Timeline timeline;
  const double step = 0.04 + 0.01 * variant;
  for (int f = 0; f < 30; ++f) timeline.time_s.push_back(step * f);
  timeline.duration_s = 30 * step;
  return timeline;
});

// Silence, then movement; silence, then sound.
const Maker starting_mouth = made([](int variant) {
  face::Weights weights;
  weights.values.assign(face::arkit_count, 0.01f * static_cast<float>(std::max(0, variant - 5)));
  return weights;
});
const Maker starting_audio = changed<face::Audio>(another("audio", 0), [](face::Audio& audio, int variant) {
  const std::size_t quiet = 1600 + 800 * static_cast<std::size_t>(variant);
  for (std::size_t i = 0; i < std::min(quiet, audio.samples.size()); ++i)
    audio.samples[i] *= 0.1f * static_cast<float>(i) / static_cast<float>(quiet);
});

// Turned about the upright axis, farther in every variant.
const Maker turned_camera = changed<face::Camera>(another("camera", 0), [](face::Camera& camera, int variant) {
  const auto c = static_cast<float>(std::cos(0.1 * variant)), s = static_cast<float>(std::sin(0.1 * variant));
  camera.cam_from_world = {c, 0, s, 0, 1, 0, -s, 0, c};
});

// A truth is not what is judged.
const Registered evaluate({
    .inputs =
        {
            {"evaluate.clustering.labels", columns_of({{0, 0, 0, 1, 1, 1}, {0, 1, 0, 1, 0, 1}})},
            {"evaluate.clustering.exemplars", columns_of({{1, 4}, {0, 3}})},
            {"evaluate.clustering.planted", columns_of({{0, 0, 0, 1, 1, 2}, {0, 1, 1, 1, 1, 1}})},
            {"evaluate.curve_plot.curves", curves},
            {"evaluate.curve_plot.more", curves},
            {"evaluate.face_fit.camera", turned_camera},
            {"evaluate.landmarks.track", face_points},
            {"evaluate.landmarks.truth",
             [](engine::Plugins& plugins, int variant) { return face_points(plugins, variant + 2); }},
            {"evaluate.lip_gap.truth", another("weights")},
            {"evaluate.lip_gap.timeline", spread_timeline},
            {"evaluate.lip_vertex_error.truth", another("weights")},
            {"evaluate.mesh_error.truth", another("mesh_points")},
            {"evaluate.mouth_time_offset.weights", speaking_mouth},
            {"evaluate.mouth_time_offset.truth", true_mouth},
            {"evaluate.mouth_time_offset.timeline", long_timeline},
            {"evaluate.sync.weights", starting_mouth},
            {"evaluate.sync.audio", starting_audio},
            {"evaluate.sync.timeline", long_timeline},
            {"evaluate.texture_consistency.frames", another("image")},
        },
    .lengths = {{"evaluate.mouth_time_offset.weights", 30},
                {"evaluate.mouth_time_offset.truth", 30},
                {"evaluate.sync.weights", 30}},
    .values = {{"evaluate.curve_plot.start_s", {0.03}}},
});

}  // namespace
}  // namespace conformance
