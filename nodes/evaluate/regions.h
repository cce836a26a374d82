// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/types/rig.h"
#include "nodes/types/vertex_mask.h"

namespace face::evaluate {

struct Region {
  std::string name;
  std::vector<std::uint32_t> vertices;  // ascending
};

// Vertices of the parts that hold the 68 landmarks (the skin); all that polygons use where a rig has no landmarks or no
// parts.
std::vector<std::uint32_t> skin_vertices(const Rig& rig);

// Vertices of the skin inside the outer outline of the lips (landmarks 48 to 59, seen from the front, plus 1 mm), at
// most 20 mm behind its foremost point. Without landmarks the inner lip pairs and the lower lip.
std::vector<std::uint32_t> lip_vertices(const Rig& rig);

// Skin from 2 mm below the lower lids (landmarks 40, 41, 46, 47) upwards, in front of the temples (10 mm behind
// landmarks 17 and 26, where brows end): lids, brows, forehead.
std::vector<std::uint32_t> upper_face_vertices(const Rig& rig);

// "lips", "upper_face", "middle_face" (between lids and the upper lip), "lower_face" (from there down, without the
// lips), all in front of the temples, "rest" of the skin, and "all" of it. Without landmarks "all" alone.
std::vector<Region> face_regions(const Rig& rig);

// Vertices that the jaw leaves alone, for rigid alignment: skin that jawOpen moves less than 0.1 mm.
std::vector<std::uint32_t> jaw_free_vertices(const Rig& rig);

// The mask's vertices, or the given ones where there is no mask. Throws where the mask is not the rig's, or nothing is
// in it. name: what messages call it.
std::vector<std::uint32_t> chosen_vertices(const VertexMask* mask, std::size_t vertex_count, const char* name,
                                           const std::vector<std::uint32_t>& otherwise);

}  // namespace face::evaluate
