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

// Upper lashes as one part. Each vertex hangs on a vertex of the skin (`anchor`, one per vertex).
struct Attached {
  VertexRange range;
  std::vector<std::uint32_t> anchors;
};
Attached add_lashes(HeadBuilder& head, const Skin& skin);

}  // namespace face::phantom
