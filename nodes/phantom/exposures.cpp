// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/exposures.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"

namespace face::phantom {
namespace {

Weights between(const Weights& a, const Weights& b, double share) {
  Weights mixed;
  mixed.values.assign(std::max(a.values.size(), b.values.size()), 0.0f);
  for (std::size_t i = 0; i < a.values.size(); ++i) mixed.values[i] += static_cast<float>(1 - share) * a.values[i];
  for (std::size_t i = 0; i < b.values.size(); ++i) mixed.values[i] += static_cast<float>(share) * b.values[i];
  return mixed;
}

RigidMotion between(const RigidMotion& a, const RigidMotion& b, double share) {
  RigidMotion mixed;
  auto& r = mixed.rotation;
  for (std::size_t i = 0; i < 9; ++i) r[i] = (1 - share) * a.rotation[i] + share * b.rotation[i];
  for (std::size_t i = 0; i < 3; ++i)
    mixed.translation_mm[i] = (1 - share) * a.translation_mm[i] + share * b.translation_mm[i];
  // Gram and Schmidt: rows 0 and 1, then their cross product.
  const double first = std::hypot(r[0], r[1], r[2]);
  for (std::size_t i = 0; i < 3; ++i) r[i] /= first;
  const double along = r[0] * r[3] + r[1] * r[4] + r[2] * r[5];
  for (std::size_t i = 0; i < 3; ++i) r[3 + i] -= along * r[i];
  const double second = std::hypot(r[3], r[4], r[5]);
  for (std::size_t i = 0; i < 3; ++i) r[3 + i] /= second;
  r[6] = r[1] * r[5] - r[2] * r[4];
  r[7] = r[2] * r[3] - r[0] * r[5];
  r[8] = r[0] * r[4] - r[1] * r[3];
  return mixed;
}

}  // namespace

Moment moment_at(const engine::Window<Weights>& weights, const engine::Window<RigidMotion>& world_from_head,
                 double offset_frames) {
  check(weights.size() == world_from_head.size() && weights.centre_index() == world_from_head.centre_index(),
        "weights come with ", weights.size(), " frames, head motion with ", world_from_head.size());
  check(std::abs(offset_frames) <= 1, "the moment is ", offset_frames, " frames away, expected at most 1");
  const std::size_t centre = weights.centre_index();
  const bool later = offset_frames > 0;
  const bool alone = later ? centre + 1 >= weights.size() : centre == 0;
  if (offset_frames == 0 || alone) return {weights.centre(), world_from_head.centre()};
  const std::size_t other = later ? centre + 1 : centre - 1;
  const double share = std::abs(offset_frames);
  return {between(weights[centre], weights[other], share),
          between(world_from_head[centre], world_from_head[other], share)};
}

}  // namespace face::phantom
