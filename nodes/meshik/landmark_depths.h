// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"
#include "nodes/types/rig.h"

namespace face::meshik {

// How far every landmark of a face at rest, seen from the front, is towards the viewer, pixels: the rig's depth there,
// at the scale at which its landmarks lie nearest to the given ones (landmark_scale_mm). What track.stabilise needs to
// take turns and nods out. N x 1; only differences mean something. A landmark that the rig does not know by name lies
// in the mean of the others. neutral: N, see landmark_vertices.
Matrix landmark_depths(const Rig& rig, const Landmarks& neutral);

}  // namespace face::meshik
