// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/key_shapes.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::cluster {

// The key shapes that exemplars stand for, largest group first. tracks: as given to landmark_points, frames: its second
// result, labels and exemplars: of its rows.
KeyShapes gather_key_shapes(const engine::Seq<Landmarks>& tracks, const Matrix& frames, const Matrix& labels,
                            const Matrix& exemplars);

}  // namespace face::cluster
