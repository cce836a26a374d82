// SPDX-License-Identifier: Apache-2.0
// A face of five by seven vertices whose metrics can be worked out by hand.
#pragma once
#include <vector>

#include "engine/port.h"
#include "nodes/types/arkit.h"
#include "nodes/types/phones.h"
#include "nodes/types/rig.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace test {

// Vertices on a plane, 10 mm apart, row 0 below; the lips are rows 1 (lower) and 2 (upper), which lie on each other.
// jawOpen moves the lower lip and what is below by 10 mm down; browInnerUp moves the two top rows by 4 mm up.
inline face::Rig small_face() {
  face::Rig rig;
  const std::vector<float> heights = {-20, 0, 0, 10, 20, 30, 40};
  for (const float y : heights)
    for (int c = 0; c < 5; ++c) rig.neutral.points_mm.push_back({10.0f * static_cast<float>(c - 2), y, 0});
  rig.neutral.polygon_starts.push_back(0);
  for (std::uint32_t r = 0; r + 1 < heights.size(); ++r)
    for (std::uint32_t c = 0; c + 1 < 5; ++c) {
      if (r == 1) continue;  // the mouth
      for (const std::uint32_t v : {5 * r + c, 5 * r + c + 1, 5 * r + c + 6, 5 * r + c + 5})
        rig.neutral.corners.push_back(v);
      rig.neutral.polygon_starts.push_back(static_cast<std::uint32_t>(rig.neutral.corners.size()));
    }
  rig.shapes.resize(face::arkit_count);
  for (std::size_t s = 0; s < face::arkit_count; ++s) rig.shapes[s].name = std::string(face::arkit_names[s]);
  face::Shape& jaw = rig.shapes[face::arkit_index("jawOpen")];
  for (std::uint32_t v = 0; v < 10; ++v) jaw.vertices.push_back(v), jaw.offsets_mm.push_back({0, -10, 0});
  face::Shape& brow = rig.shapes[face::arkit_index("browInnerUp")];
  for (std::uint32_t v = 25; v < 35; ++v) brow.vertices.push_back(v), brow.offsets_mm.push_back({0, 4, 0});
  for (std::uint32_t c = 1; c < 4; ++c) rig.inner_lips.push_back({10 + c, 5 + c});
  return rig;
}

inline face::Weights jaw(double open, double brow = 0) {
  face::Weights weights;
  weights.values.assign(face::arkit_count, 0.0f);
  weights.values[face::arkit_index("jawOpen")] = static_cast<float>(open);
  weights.values[face::arkit_index("browInnerUp")] = static_cast<float>(brow);
  return weights;
}

inline engine::Seq<face::Weights> jaws(const std::vector<double>& open) {
  std::vector<face::Weights> frames;
  for (const double value : open) frames.push_back(jaw(value));
  return engine::Seq<face::Weights>(frames);
}

inline face::Timeline every(double step_s, std::size_t frames) {
  face::Timeline timeline;
  for (std::size_t i = 0; i < frames; ++i) timeline.time_s.push_back(step_s * static_cast<double>(i));
  timeline.duration_s = step_s * static_cast<double>(frames);
  return timeline;
}

inline face::Phones spoken(const std::vector<std::pair<std::string, double>>& labels_and_ends_s) {
  face::Phones phones;
  double start_s = 0;
  for (const auto& [label, end_s] : labels_and_ends_s) {
    phones.phones.push_back({label, start_s, end_s, "", 0});
    start_s = end_s;
  }
  phones.duration_s = start_s;
  return phones;
}

}  // namespace test
