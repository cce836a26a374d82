// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/phantom/head_builder.h"
#include "nodes/phantom/head_surface.h"

namespace face::phantom {

// Loops around the mouth: column 0 is the corner on the head's left, then along the upper lip to the right corner (36)
// and back along the lower lip. Ring 0 is the border of the red of the lips, rings 1.. lie on the skin, ring -4 is
// where the lips touch, and deeper rings line the mouth.
inline constexpr int kMouthColumns = 72;
inline constexpr int kMouthOuterRing = 7;
inline constexpr int kLipContactRing = -4;
inline constexpr int kMouthDeepestRing = -11;

// Loops around the left eye: column 0 is the outer corner, then along the upper lid to the inner corner (26) and back
// along the lower lid. Ring 0 is the front edge of the lid, ring -1 its edge on the eyeball, ring -2 is tucked in
// behind.
inline constexpr int kEyeColumns = 52;
inline constexpr int kEyeOuterRing = 7;
inline constexpr int kEyeDeepestRing = -2;

// What the sculpting knows of a vertex of the skin.
struct SkinVertex {
  enum class Loop { none, mouth, left_eye, right_eye };
  ChartPoint at;
  Loop loop = Loop::none;
  int ring = 0;
  int column = 0;
};

// Skin, lips, lids and mouth lining as one connected surface. Its vertices are the first of the builder.
struct Skin {
  std::vector<SkinVertex> vertices;
  std::vector<std::vector<std::uint32_t>> neighbours;  // along edges

  std::uint32_t mouth(int ring, int column) const;
  std::uint32_t left_eye(int ring, int column) const;
  std::uint32_t right_eye(int ring, int column) const;

  std::vector<std::vector<std::uint32_t>> mouth_rings, left_eye_rings,
      right_eye_rings;  // from the deepest ring outwards
};

// Lays the skin out, shapes it, and adds it to the (empty) builder as the parts "face" and "mouth_socket".
Skin add_skin(HeadBuilder& head);

}  // namespace face::phantom
