// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/mouth_contacts.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "nodes/base/mouth.h"
#include "nodes/types/arkit.h"

namespace face::phantom {
namespace {

constexpr std::size_t kJawOpen = arkit_index("jawOpen"), kMouthClose = arkit_index("mouthClose");

double offset_y(const Shape& shape, std::uint32_t vertex) {
  const auto at = std::lower_bound(shape.vertices.begin(), shape.vertices.end(), vertex);
  if (at == shape.vertices.end() || *at != vertex) return 0;
  return shape.offsets_mm[static_cast<std::size_t>(at - shape.vertices.begin())][1];
}

std::vector<double> gap_rows(const Rig* rig) {
  std::vector<double> rows(arkit_count, 0.0);
  if (!rig || rig->inner_lips.empty()) {
    rows[kJawOpen] = 1;
    rows[kMouthClose] = -1;
    return rows;
  }
  for (std::size_t s = 0; s < std::min(rig->shapes.size(), arkit_count); ++s)
    for (const LipPair& pair : rig->inner_lips)
      rows[s] += (offset_y(rig->shapes[s], pair.upper) - offset_y(rig->shapes[s], pair.lower)) /
                 static_cast<double>(rig->inner_lips.size());
  return rows;
}

MouthContacts::LipTeethPose find_lip_teeth(const Rig& rig) {
  MouthContacts::LipTeethPose best;
  const LipTeeth measure(rig);
  if (!measure.usable()) return best;
  double least = 1e9;
  for (double upper = 0.15; upper < 0.42; upper += 0.13)
    for (double jaw = 0; jaw < 0.17; jaw += 0.02)
      for (double roll = 0.3; roll < 1.01; roll += 0.05) {
        std::vector<float> weights(arkit_count, 0.0f);
        weights[kJawOpen] = static_cast<float>(jaw);
        weights[arkit_index("mouthRollLower")] = static_cast<float>(roll);
        weights[arkit_index("mouthUpperUpLeft")] = weights[arkit_index("mouthUpperUpRight")] =
            static_cast<float>(upper);
        const double distance_mm = measure.nearest(weights).distance_mm;
        // A touch; of touches the one with the least effort. Inside the teeth counts fourfold.
        const double touch_mm = distance_mm < 0 ? -4 * distance_mm : distance_mm;
        const double cost = std::max(touch_mm, 0.15) + 0.6 * std::abs(jaw - 0.06) + 0.15 * roll + 0.2 * upper;
        if (cost >= least) continue;
        least = cost;
        best = {roll, jaw, upper, distance_mm};
      }
  return best;
}

}  // namespace

MouthContacts::MouthContacts(const Rig* rig) : gap_per_weight_(gap_rows(rig)) {
  if (rig) lip_teeth_ = find_lip_teeth(*rig);
}

double MouthContacts::gap_mm(const std::vector<float>& weights, std::size_t without) const {
  double gap = 0;
  for (std::size_t s = 0; s < arkit_count; ++s)
    if (s != without) gap += gap_per_weight_[s] * double{weights[s]};
  return gap;
}

void MouthContacts::close_lips(double shut, std::vector<float>& weights) const {
  const double per_close = gap_per_weight_[kMouthClose], per_jaw = gap_per_weight_[kJawOpen];
  double gap = gap_mm(weights, kMouthClose);
  if (gap < 0 && per_jaw > 0) {
    weights[kJawOpen] = static_cast<float>(std::min(1.0, weights[kJawOpen] - gap / per_jaw));
    gap = gap_mm(weights, kMouthClose);
  }
  if (per_close >= 0) return;  // a rig without mouthClose
  weights[kMouthClose] = static_cast<float>(std::clamp(shut * gap / -per_close, 0.0, 1.0));
}

}  // namespace face::phantom
