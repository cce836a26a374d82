// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/camera.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/weights.h"

namespace face::phantom {

enum class LandmarkSet { multipie68, lips18 };

struct TruthLandmarksOptions {
  int width_px = 640;
  int height_px = 480;
  LandmarkSet set = LandmarkSet::multipie68;
};

// Where a rig's named points are in a picture, exact. A point is valid where the camera sees it: within the picture and
// not more than 3 mm behind what is seen there (the points of a contour lie on the edge of what is seen).
// multipie68: the rig's landmarks68, "00" to "67" in Multi-PIE order.
// lips18: what a lip tracker follows: eye_inner_r, eye_inner_l, nose_tip, lip_0 to lip_11 (outer lip,
// from the corner on the head's right over the upper lip), jaw_r, chin, jaw_l (chin and 16 mm or so beside it).
// Throws where the rig has no landmarks68.
Landmarks truth_landmarks(const Rig& rig, const Weights& weights, const RigidMotion* world_from_head,
                          const Camera& camera, const TruthLandmarksOptions& options = {});

}  // namespace face::phantom
