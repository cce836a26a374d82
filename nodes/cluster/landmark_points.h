// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::cluster {

struct LandmarkPointsResult {
  Matrix points;  // T' x 2N: x, y of every landmark, px, of the frames where all are valid
  Matrix frames;  // T' x 1: the position of each of these frames in the sequence
};

// The tracks as a matrix for the solvers. Every frame has the first one's landmarks in the same order.
LandmarkPointsResult landmark_points(const engine::Seq<Landmarks>& tracks);

}  // namespace face::cluster
