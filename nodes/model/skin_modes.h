// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"

namespace face::model {

// Linear reflectance of every vertex: its part's times its own colour. 0.6 where neither is known.
std::vector<Vec3f> vertex_albedo(const Mesh& mesh);

// True for the vertices of skin: parts named "face", or all where the mesh has no such part.
std::vector<bool> skin_vertices(const Mesh& mesh);

// Components of albedo that are made, not measured: `count` at most. landmarks68: Multi-PIE order, or empty for waves
// and tone alone.
LinearSpace skin_modes(const Mesh& mesh, const std::vector<Vec3f>& albedo,
                       const std::vector<std::uint32_t>& landmarks68, std::size_t count);

// Mean and principal components of the skins of made persons (phantom.make_person) on this rig, in linear reflectance;
// coefficient 1 is one standard deviation. The rig needs its 68 landmarks.
struct SkinSpace {
  std::vector<Vec3f> mean;
  LinearSpace modes;
};
SkinSpace learn_skins(const Rig& rig, std::size_t skins, std::size_t count, std::int64_t seed);

}  // namespace face::model
