// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/landmarks.h"
#include "nodes/types/rig.h"
#include "nodes/types/vertex_targets.h"

namespace face::mmm {

struct ScaleMotionOptions {
  bool hold_head = true;
};

// Where a mesh's vertices have to be when the points of a face in a video have moved (Speech-Driven 3D Facial
// Animation, section 3.2): d_ij = f_ij - f_rj, v'_j = Pi(v_j) + S_k d_ij, seen orthographically from the front, so that
// x and y are asked for and z is free. S_k is, for x and for y, the ratio of the bounding boxes of part k on the mesh
// and on the reference frame; the parts are left eye, right eye, mouth and the whole face. A part with fewer than three
// points, or whose box is thinner than a tenth of the whole face's in one direction, uses the whole face's box.
//
// rig: with landmarks68, whose mesh at rest is like the reference frame's face. reference, landmarks: the same points
// by name: the layout of 18 (lip_0, ..., see meshik::landmark_vertices) or "00" to "67" of Multi-PIE; a point that is
// not valid in either frame asks for nothing, and so do points of other names. Differs from the paper: hold_head first
// takes out the similarity that brings the points that move with the skull (inner eye corners and tip of the nose) back
// to where they are in the reference, which the paper leaves to the speaker. With fewer than two of them nothing is
// taken out. still: vertices that are held at rest besides (meshik::still_vertices), null = none; where a point asks
// for the same vertex, the point counts.
VertexTargets scale_motion(const Rig& rig, const Landmarks& reference, const Landmarks& landmarks,
                           const VertexTargets* still, const ScaleMotionOptions& options = {});

}  // namespace face::mmm
