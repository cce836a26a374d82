// SPDX-License-Identifier: Apache-2.0
// The motion of the head by all that is seen between brows and nose. Internal to the area.
#pragma once
#include <array>

#include "nodes/track/patch.h"
#include "nodes/track/solid_head.h"
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::track {

// What is between the brows and the tip of the nose, seen from the front at the start: grey, on a raster that hangs at
// the inner corners of the eyes. Empty where the points do not say where these and the tip of the nose are.
Image learn_head(const Grey& grey, const Landmarks& start);

// Likeness from which on a head is taken for seen.
constexpr double head_is_seen = 0.45;

struct HeadSight {
  HeadPose pose;        // since the start
  double likeness = 0;  // to what was learnt: 1 the same, 0 no more than any picture; what differs much counts less
};

// How the head of learn_head has moved. from: where it is looked for first, the pose in the previous frame. The head
// is a solid of usual proportions under weak perspective; its six numbers are those at which the picture, sampled where
// the raster's places are then seen, differs least from what was learnt (Gauss-Newton, weights that fall with the
// difference, coarse to fine). As Xiao, Moriyama, Kanade and Cohn, Robust Full-Motion Recovery of Head by Dynamic
// Templates and Re-registration Techniques, IJIST 2003, who follow a cylinder; differs from it: the solid has a nose,
// which tells a turn from a step aside; there is one template, that of the start, so that nothing drifts; both pictures
// are freed from local brightness and contrast first, so that light that changes with the turn is not motion.
HeadSight find_head(const Grey& grey, const Landmarks& start, const Image& learnt, const HeadPose& from);

// As a value of a graph, 7 x 1: the pose's numbers and the likeness; and back. Throws where it is something else.
Matrix head_numbers(const HeadSight& sight);
HeadSight head_sight(const Matrix& head);

// Its pose at the start.
HeadPose start_pose(const Landmarks& start);

// The solid in that pose: takes places of the start's picture to the picture's.
SolidHead head_at(const HeadPose& pose, const Landmarks& start);

}  // namespace face::track
