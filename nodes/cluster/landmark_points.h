// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::cluster {

struct LandmarkPointsOptions {
  int max_lost = 0;  // so many landmarks of a frame may be lost: they count where the tracker has left them
};

struct LandmarkPointsResult {
  Matrix points;  // T' x 2N: x, y of every landmark, px, of the frames where enough are valid
  Matrix frames;  // T' x 1: the position of each of these frames in the sequence
};

// The tracks as a matrix for the solvers. Every frame has the first one's landmarks in the same order.
LandmarkPointsResult landmark_points(const engine::Seq<Landmarks>& tracks, const LandmarkPointsOptions& options = {});

}  // namespace face::cluster
