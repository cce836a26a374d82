// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/depth_scan.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"

namespace face::model {

// Takes the edges of a mesh out of the openings of a scan: where a scan shows the inside of a mouth, taken out, there
// is no lip, and what lies beyond it is the other lip's. A vertex within four edges of the mesh's border is looked at
// from the nearest one that is four edges away from it, or, if that lies in the opening too, eight or twelve (then also
// a vertex farther within, if it lies in the opening): where the straight way to it, in the scan's picture, comes to a
// hole that measured surface lies around (what is beside the face is none), it stays at the last measured pixel before.
// mesh, shape: a reference's and where its vertices are in the scan, in the world of the scan's camera, of
// sample_scan. Lips that roll in are then seen to end where the scan sees them end; where they truly are out of sight,
// the smooth continuation of sample_scan is nearer.
MeshPoints leave_openings(const Mesh& mesh, const MeshPoints& shape, const DepthScan& scan);

}  // namespace face::model
