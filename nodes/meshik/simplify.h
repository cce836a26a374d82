// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/matrix.h"
#include "nodes/types/mesh.h"
#include "nodes/types/rig.h"

namespace face::meshik {

struct SimplifyOptions {
  std::int64_t vertices = 3201;  // Speech-Driven 3D Facial Animation, section 4
  double detail = 30;
  double detail_mm = 10;
};

struct SimplifyResult {
  Rig rig;  // the head with fewer vertices, its shapes and landmarks
  // V x 6 (V of the whole head): three vertices of the simplified one, and their shares, which add up to 1: the place
  // on the simplified surface of the same connected part that is nearest at rest. A part of which nothing is left has
  // shares of 0.
  Matrix binding;
  std::int64_t triangles = 0;
};

// A head and example poses of it with fewer vertices and one connectivity (Speech-Driven 3D Facial Animation, section
// 4, simplifies 23,725 vertices to 3,201), so that MeshIK solves for few unknowns: the same collapses for all poses
// (collapse_set.h). examples: meshes with the rig's vertices; those of the result are their vertices that are left.
// Near the landmarks of eyes and lips (36 to 67) taking a vertex away costs up to 1 + detail times as much, falling off
// with a Gaussian of deviation detail_mm. Landmarks and the pairs of the lips stay. Colours stay with their vertices,
// texture coordinates are left out.
SimplifyResult simplify(const Rig& rig, const engine::Seq<Mesh>& examples, engine::SeqWriter<Mesh>& simple_examples,
                        const SimplifyOptions& options = {});

}  // namespace face::meshik
