// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/phantom/head_builder.h"

namespace face::phantom {

// Vertices that hang on the skin: each moves by the weighted sum of its anchors' offsets.
struct Anchor {
  std::uint32_t vertex = 0;
  double weight = 1;
};
struct Attached {
  VertexRange range;
  std::vector<std::vector<Anchor>> anchors;  // one list per vertex
};

// Adds the anchors of the right side, where those of the left side are given.
inline void mirror_anchors(const HeadBuilder& head, Attached& attached) {
  const std::size_t count = attached.anchors.size();
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<Anchor> anchors = attached.anchors[k];
    for (Anchor& anchor : anchors) anchor.vertex = head.mirror[anchor.vertex];
    attached.anchors.push_back(anchors);
  }
}

}  // namespace face::phantom
