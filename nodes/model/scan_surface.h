// SPDX-License-Identifier: Apache-2.0
// What is asked of a surface that was cut from a scan (model.scan_template).
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/types/morphable_model.h"

namespace face::model {

// The hole of the mouth in a template: its vertices in order, once around; empty where there is none.
std::vector<std::uint32_t> mouth_loop(const MorphableModel& surface);

// The ends of that hole, upper and lower, in every column of the reference's picture, from the head's right to its
// left.
std::vector<LipPair> lip_pairs(const MorphableModel& surface, const std::vector<std::uint32_t>& loop);

// Throws where polygons, parts, landmarks, uvs or colours of a surface do not belong together, or are not finite.
void check_surface(const MorphableModel& surface);

// The number of leading vertices that are skin: teeth and the inside of the mouth come after them. Checks the surface.
std::size_t skin_count(const MorphableModel& surface);

}  // namespace face::model
