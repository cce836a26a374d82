// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/matrix.h"
#include "nodes/types/weights.h"

namespace face::mmm {

// The parameters of a frame whose numbers (find_components) are given. An empty frame stays empty.
Weights from_components(const Matrix& components, const Weights& numbers);

}  // namespace face::mmm
