// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/matrix.h"

namespace face::meshik {

// meshik::reconstruct for matrices: many frames at once, in double precision. reference: V x 3, examples: K x 3 V (or
// 3 V x 1 for one), faces: F x 3 (triangles) or F x 4 (quads), weights: T x K, or K x 1 for one frame.
// Returns T x 3 V.
Matrix reconstruct_matrix(const Matrix& reference, const Matrix& examples, const Matrix& faces, const Matrix& weights);

}  // namespace face::meshik
