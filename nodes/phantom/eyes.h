// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/head_builder.h"
#include "nodes/phantom/skin_layout.h"

namespace face::phantom {

// A run of vertices of the builder.
struct VertexRange {
  std::uint32_t first = 0, end = 0;
};

// The left and the right eyeball as the parts sclera_left, iris_left (with the pupil), sclera_right, iris_right.
struct Eyes {
  VertexRange left, right;
};
Eyes add_eyes(HeadBuilder& head);

// Vertices that hang on the skin: each moves by the weighted sum of its anchors' offsets.
struct Anchor {
  std::uint32_t vertex = 0;
  double weight = 1;
};
struct Attached {
  VertexRange range;
  std::vector<std::vector<Anchor>> anchors;  // one list per vertex
};

// Upper lashes as one part.
Attached add_lashes(HeadBuilder& head, const Skin& skin);

// Adds the anchors of the right side, where the anchors of the left side are given.
void mirror_anchors(const HeadBuilder& head, Attached& attached);

}  // namespace face::phantom
