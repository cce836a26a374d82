// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"

namespace face::transfer {

struct FindOpeningsOptions {
  double least_area = 0.1;
  std::int64_t fewest_frames = 2;
};

// Openings of a reference scan that lids shut: eyes. Found by what a stream hides, without a model of eyes: triangles
// of mesh that keep less than least_area of their area in fewest_frames or more hang together in an eye, as lids hide
// it. (What lies at the mesh's own edge, a lip, is none.) The edge of that is then moved to where the reference's
// picture has an edge: over its normals, by dynamic programming along the closed curve, what is bright inside, as the
// white of an eye, before what is dark, with as many harmonics as an eye's outline needs; lashes are as dark as an
// iris, and there the curve goes on as it did beside it.
// shapes, frames: of all frames. The points of opening 1 are named "1.0", "1.1", ... in their order about it.
Landmarks find_openings(const Mesh& mesh, const DepthScan& reference, const engine::Seq<MeshPoints>& shapes,
                        const engine::Seq<DepthScan>& frames, const FindOpeningsOptions& options = {});

}  // namespace face::transfer
