// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/depth_scan.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"

namespace face::transfer {

struct DrawOpeningsOptions {
  double least_open = 0.75;
  double least_gain = 0.6;
};

// Draws openings that lids shut as layers where one sheet of triangles cannot: skin with a hole, and the eye behind it,
// in the reference's texture on a frame. Where a frame's mesh keeps less than least_open of an opening's area, the
// layers are fitted to the frame (fit_opening), from where the mesh has them and from lids that are shut by thirteen
// shares, the two that look best; lids move across the opening. They are drawn where they differ from the frame,
// squared, by less than least_gain of what the mesh does.
// drawn: of draw_texture, and what is returned elsewhere. reference, frame: as the shape was learned from them;
// texture: the reference with the picture that is drawn, or the same. openings: of find_openings, in the reference's
// picture.
Image draw_openings(const Image& drawn, const Landmarks& openings, const Mesh& mesh, const DepthScan& reference,
                    const DepthScan* texture, const MeshPoints& shape, const DepthScan& frame,
                    const DrawOpeningsOptions& options = {});

}  // namespace face::transfer
