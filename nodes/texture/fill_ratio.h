// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/albedo_map.h"

namespace face::texture {

// Where a map's weight is below sure_weight, moves its albedo towards the estimate times the ratio of albedo and
// estimate in the sure texels around, found by pull and push over a pyramid (Gortler, Grzeszczuk, Szeliski, Cohen: The
// Lumigraph, SIGGRAPH 1996, section 3.4). estimate: of the map's size; 0 = no texel.
void fill_ratio(const std::vector<Vec3f>& estimate, float sure_weight, AlbedoMap& map);

}  // namespace face::texture
