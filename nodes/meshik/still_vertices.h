// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/mesh.h"
#include "nodes/types/vertex_targets.h"

namespace face::meshik {

struct StillVerticesOptions {
  std::int64_t count = 40;
  double still_mm = 0.02;  // a vertex that no example moves farther stands still
};

// Vertices that no example moves, spread over the mesh, as targets at rest in x, y and z. MeshIK knows triangles only
// by how they turn and stretch: a face whose points are pulled aside goes with them as a whole, and away from the
// eyeballs, which are parts of their own. With these it is held where the skull is.
// examples: meshes with the reference's vertices. The first vertex is the still one farthest from the middle of all
// still ones, each next one is farthest from those that are chosen (Gonzalez, Clustering to Minimize the Maximum
// Intercluster Distance, 1985). Connected parts in which nothing moves are left out: nothing pulls them. Fewer than
// count where there are no more.
VertexTargets still_vertices(const Mesh& reference, const engine::Seq<Mesh>& examples,
                             const StillVerticesOptions& options = {});

}  // namespace face::meshik
