// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/decode/length_unit.h"
#include "nodes/types/mesh_points.h"

namespace face::decode {

struct ReadPointsOptions {
  LengthUnit unit = LengthUnit::automatic;  // of the lengths in the file
};

// Reads the vertices of an animation, a frame after the other, ids from 0: an array of NumPy of the shape frames x
// vertices x 3 (or frames x 3 vertices; VOCASET's data_verts has this form), or a point cache .pc2 (as Blender's Mesh
// Cache reads it: "POINTCACHE2", version 1, vertices, start, rate, frames, then floats, all little endian). The unit is
// told by the first frame.
engine::Seq<MeshPoints> read_points(const engine::File& file, const ReadPointsOptions& options = {});

}  // namespace face::decode
