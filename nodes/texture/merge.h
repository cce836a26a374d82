// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/albedo_map.h"

namespace face::texture {

// One map from the maps of several pictures of a person: each texel the mean by weight; where no picture shows it, the
// mean of all. Maps need equal sizes.
AlbedoMap merge(const engine::Seq<AlbedoMap>& maps);

}  // namespace face::texture
