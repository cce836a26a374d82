// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/cylinder_scan.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/image.h"
#include "nodes/types/matrix.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"

namespace face::model {

struct ScanMeshOptions {
  std::int64_t stride_px = 2;
  double longest_edge_mm = 16;  // as far as a nose hangs over its lip
};

// The mesh of a reference scan: the vertices and triangles of scan_grid, which sample_scan samples; colours are the
// picture's grey, uvs places in it.
Mesh scan_mesh(const DepthScan& reference, const ScanMeshOptions& options = {});

struct SampleScanResult {
  MeshPoints shape;    // V points in the world of the aligned scans: the shape vector s of Eq. 5
  Image texture;       // grey, V x 1: the texture vector t of Eq. 6
  double sampled = 0;  // share of the vertices that were measured; the others are filled in
};

// Samples a scan in correspondence with a reference (Bargmann, Blanz and Seidel, Eqs. 5 and 6): vertex by vertex of
// scan_mesh, the depth and grey at where the flow says, bilinear. A vertex whose flow is not valid, or that finds no
// depth, is displaced as its neighbours are (the harmonic continuation of their displacement over the reference's grid,
// found from coarse to fine). target: aligned, so that its world is the reference's. options: as of scan_mesh.
SampleScanResult sample_scan(const DepthScan& reference, const DepthScan& target, const FlowField& flow,
                             const ScanMeshOptions& options = {});

struct RegionWeightsOptions {
  double centre_x = 0.5;  // of the picture's width
  double centre_y = 0.68;
  double width = 0.26;
  double height = 0.3;
  double feather = 0.35;  // share of the half axes over which weights fall to 0
};

// Weights of the vertices of scan_mesh for region_pca: 1 within an ellipse of the reference's picture (the mouth),
// falling smoothly to 0 at its border, 0 outside. V x 1. mesh: of scan_mesh (its uvs are places in the picture).
Matrix region_weights(const Mesh& mesh, const RegionWeightsOptions& options = {});

}  // namespace face::model
