// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/depth_scan.h"
#include "nodes/types/image.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"

namespace face::transfer {

struct DrawTextureOptions {
  double least_area = 0.1;
  std::int64_t edge_px = 0;
};

struct DrawTextureResult {
  Image drawn;    // grey, as large as the frame's picture; 0 where nothing is drawn
  Image picture;  // the frame's own, grey
  Image mask;     // 255 where the face is drawn, but for edges of edge_px
};

// The reference's texture on a frame: the mesh with a frame's shape as that frame's camera sees it, every pixel in the
// grey of the reference's picture there (GreySpline). Where the shape is right and light does not change, it is the
// frame's own picture (evaluate.texture_consistency tells how nearly). mesh: of model.scan_mesh, whose uvs are places
// in the reference's picture; shape: its vertices in the frame, in the world of frame's camera (model.sample_scan's, of
// align.orient's aligned scans). seen: the same frame with another picture, to compare with that; null = frame's own.
// Where most triangles keep less than least_area of the area that they have in the reference's picture, the surface is
// hidden: the mesh, which is one sheet, has an eye between its lids also when they are shut. It is not drawn, nor are
// the triangles beside it, whose pixels the reference shows mixed with it; what pixels they had are as those about
// them. A pixel on the edge of a lip has teeth in it, of which the texture knows nothing: to judge the rest alone, mask
// leaves out pixels nearer than edge_px + 1 to what is not drawn (such a pixel and a lens's blur reach one).
// Throws what check_texture throws.
DrawTextureResult draw_texture(const Mesh& mesh, const DepthScan& reference, const MeshPoints& shape,
                               const DepthScan& frame, const DepthScan* seen = nullptr,
                               const DrawTextureOptions& options = {});

// Throws where the reference, the frame or the shape do not belong to the mesh.
void check_texture(const Mesh& mesh, const DepthScan& reference, const MeshPoints& shape, const DepthScan& frame);

}  // namespace face::transfer
