// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/mesh.h"
#include "nodes/types/rig.h"
#include "nodes/types/vertex_mask.h"

namespace face::transfer {

struct MarkLipsOptions {
  double middle_share = 0.5;
  double reach_mm = 9;
};

struct MarkLipsResult {
  Rig marked;
  VertexMask lips;     // within reach_mm of the opening, along the surface
  bool found = false;  // false where the mesh has no opening: the rig stays as it was, and a warning says so
};

// Tells a speaking model's rig where its lips meet, so that closure can be measured: every vertex at the edge of the
// upper lip within the middle_share of the mouth's width is paired with the vertex of the lower lip's edge nearest to
// it in x. mesh: the reference's, whose mouth is open (lip_sides.h); the rig has its vertices.
MarkLipsResult mark_lips(const Rig& rig, const Mesh& mesh, const MarkLipsOptions& options, engine::Progress& progress);

}  // namespace face::transfer
