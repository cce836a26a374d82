// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

namespace face {

// A yes or no for every vertex of a mesh.
struct VertexMask {
  std::vector<std::uint8_t> on;  // V, 0 or 1
};

}  // namespace face
