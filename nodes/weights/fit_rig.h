// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/rig.h"
#include "nodes/types/weights.h"

namespace face::weights {

struct FitRigOptions {
  // Of shapes that do nearly the same (mouthPress, mouthRoll) the fit takes a little of each and not much of one
  // against another: the square of a weight costs this share of what an average shape moves.
  double restraint = 1e-4;
};

struct FitRigResult {
  double rms_mm = 0;      // of all vertices in all frames: what the shapes do not explain
  double largest_mm = 0;  // of any vertex in any frame
};

// An animation of a head's vertices as weights of its own ARKit shapes, each 0 to 1, so that it can be edited, carried
// to another head, or played by whatever plays ARKit: those whose sum of shapes lies nearest (least squares within
// bounds; Bertsekas, Projected Newton Methods for Optimization Problems with Simple Constraints, SIAM J. Control and
// Optimization 20, 1982). points: the rig's vertices in every frame; a frame without any repeats the one before, the
// first one is at rest. Throws where the rig has no ARKit shape.
FitRigResult fit_rig(const Rig& rig, const engine::Seq<MeshPoints>& points, engine::SeqWriter<Weights>& weights,
                     const FitRigOptions& options, engine::Progress& progress);

}  // namespace face::weights
