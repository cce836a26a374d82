// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/camera.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/table.h"
#include "nodes/types/weights.h"

namespace face::evaluate {

// A fit beside the person whom it shows: one row "fit".
// vertex_mm: median of the distances of fitted and true vertices, over the skin that fits compare with pictures
//   (model/skin_basis.h), after the rotation and translation that bring them together best.
// shape_mm, shape_p90_mm: median and 90th percentile with the best scale too; size_percent: by how much the fit is too
//   large. A picture of a small head that is near and one of a large head that is far are the same picture, so size is
//   known from what goes with it in the model alone.
// pose_deg: the angle between the true orientation of the head in the camera and the fitted one, that of the head as
//   brought together above: a model's components also turn the head within its own frame. With `start` it is counted
//   from the start's: how well a head was followed, whatever its first frame was worth.
// lip_gap_mm: of the fit minus true, absolute; true_gap_mm: true. turn_deg: how far the head is truly turned away.
// landmark_percent, image_percent: what the fit says of itself; converged: 1 or 0.
// Of a fit that has no coefficients since its points were no use, all measures are NaN.
// rig: the person, of the model's vertices. world_from_head, start_world_from_head null: at rest. start: the fit of a
// take's first frame, where the head truly was at start_world_from_head.
Table face_fit(const MorphableModel& model, const FaceFit& fit, const Rig& rig, const Weights& weights,
               const RigidMotion* world_from_head, const Camera& camera, const FaceFit* start,
               const RigidMotion* start_world_from_head);

}  // namespace face::evaluate
