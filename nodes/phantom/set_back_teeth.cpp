// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/set_back_teeth.h"

#include <algorithm>
#include <vector>

#include "nodes/phantom/face_places.h"

namespace face::phantom {
namespace {

// How far the lips' contact lies before the foremost of the teeth, mm.
double clearance_mm(const Rig& rig) {
  double lips = 1e9, teeth = -1e9;
  for (const LipPair& pair : rig.inner_lips)
    lips = std::min({lips, double{rig.neutral.points_mm[pair.upper][2]}, double{rig.neutral.points_mm[pair.lower][2]}});
  for (const std::uint32_t v : rig.upper_teeth) teeth = std::max(teeth, double{rig.neutral.points_mm[v][2]});
  return lips - teeth;
}

}  // namespace

double set_back_teeth(const Rig& rig, Rig& person) {
  constexpr double kStays_mm = 0.5;
  if (rig.inner_lips.empty() || rig.upper_teeth.empty()) return 0;
  const double back_mm = clearance_mm(rig) - clearance_mm(person) - kStays_mm;
  if (back_mm <= 0) return 0;
  const std::vector<std::size_t> parts = vertex_parts(person.neutral);
  for (std::size_t v = 0; v < parts.size(); ++v)
    if (parts[v] < person.neutral.parts.size() && is_in_mouth(person.neutral.parts[parts[v]].name))
      person.neutral.points_mm[v][2] -= static_cast<float>(back_mm);
  return back_mm;
}

}  // namespace face::phantom
