// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"
#include "nodes/types/rig.h"

namespace face::meshik {

// How far every landmark of a face at rest is towards the viewer, pixels: the rig's depth there, at the scale at which
// its landmarks lie nearest to the given ones (landmark_scale_mm), of a head that is turned as they show it
// (nodes/base/head_facing.h; seen from the front where the corners of the eyes are not among them). What
// track.stabilise needs to take turns and nods out. N x 1; only differences mean something. A landmark that the rig
// does not know by name lies in the mean of the others. neutral: N, see landmark_vertices.
Matrix landmark_depths(const Rig& rig, const Landmarks& neutral);

}  // namespace face::meshik
