// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"
#include "nodes/types/surface_map.h"
#include "nodes/types/weights.h"

namespace face::phantom {

// Where a rig's landmarks68 are in the picture of a scan around an axis, "00" to "67" in Multi-PIE order: what a user
// would mark by hand on the reference scan. A point is valid within the picture; none is tested for being hidden.
Landmarks laser_landmarks(const Rig& rig, const Weights& weights, const CylinderScan& scan);

// Where the vertices of a surface that was cut from a scan (model.scan_template: its uvs are pixels of that scan) truly
// are in another face: truth says which point of the head each of these pixels shows, and that point is posed by rig
// and weights. rig: of the other face, in the same topology as the scanned one. Throws where a vertex lies on a pixel
// that shows no head, or the surface's size is not the map's. Vertices beyond the first part (teeth) are left out.
MeshPoints laser_truth(const Rig& rig, const Weights& weights, const SurfaceMap& truth, const MorphableModel& surface);

}  // namespace face::phantom
