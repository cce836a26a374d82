// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/pose_rig.h"

#include "nodes/base/pose.h"

namespace face::evaluate {

MeshPoints pose_rig(const Rig& rig, const Weights& weights) { return {pose_points(rig, weights)}; }

}  // namespace face::evaluate
