// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

namespace face {

// Where a vertex has to be. A coordinate that is not asked for stays free.
struct VertexTarget {
  std::uint32_t vertex = 0;
  double x_mm = 0;
  double y_mm = 0;
  double z_mm = 0;
  bool has_z = false;  // x and y always count
};

// Places that vertices of a mesh have to take in one frame; every vertex at most once.
struct VertexTargets {
  std::vector<VertexTarget> targets;
};

}  // namespace face
