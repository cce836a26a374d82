// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/matrix.h"
#include "nodes/types/weights.h"

namespace face::mmm {

// A frame's parameters as the numbers of find_components. An empty frame stays empty.
Weights to_components(const Matrix& components, const Weights& parameters);

}  // namespace face::mmm
