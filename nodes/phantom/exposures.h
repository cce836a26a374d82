// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <vector>

#include "engine/port.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/weights.h"

namespace face::phantom {

// A structured-light scanner takes five pictures for each of its frames; METHODS' scanner 200 a second.
inline constexpr std::size_t exposure_count = 5;

// A performer at one moment.
struct Moment {
  Weights weights;
  RigidMotion world_from_head;
};

// The performer between frames, linear from each to the next (rotations are made orthonormal again); at the ends of the
// sequence it stands still. offset_frames in [-1, 1]: 0 is the windows' centre.
Moment moment_at(const engine::Window<Weights>& weights, const engine::Window<RigidMotion>& world_from_head,
                 double offset_frames);

// Offset of an exposure from the middle one, in frames.
inline double exposure_offset(std::size_t exposure, double exposure_step) {
  return (static_cast<double>(exposure) - 0.5 * (exposure_count - 1)) * exposure_step;
}

}  // namespace face::phantom
