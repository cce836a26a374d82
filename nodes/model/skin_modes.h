// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/types/morphable_model.h"

namespace face::model {

// Linear reflectance of every vertex: its part's times its own colour. 0.6 where neither is known.
std::vector<Vec3f> vertex_albedo(const Mesh& mesh);

// True for the vertices of skin: parts named "face", or all where the mesh has no such part.
std::vector<bool> skin_vertices(const Mesh& mesh);

// Components of albedo that are made, not measured: `count` at most. landmarks68: Multi-PIE order, or empty for waves
// and tone alone.
LinearSpace skin_modes(const Mesh& mesh, const std::vector<Vec3f>& albedo,
                       const std::vector<std::uint32_t>& landmarks68, std::size_t count);

}  // namespace face::model
