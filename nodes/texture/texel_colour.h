// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/albedo_map.h"
#include "nodes/types/vec.h"

namespace face::texture {

// A map's colour at a uv, between the four texels about it; 0 outside the atlas.
Vec3f colour_at(const AlbedoMap& map, const Vec2f& uv);

}  // namespace face::texture
