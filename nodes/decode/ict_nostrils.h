// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/mesh.h"

namespace face::decode {

// How far every vertex of an ICT mesh lies inside a nostril, V: the share of directions beside and above it that lead
// into skin within 15 mm, or straight into the vertex's own. About 1 in the nostrils, which are shallow pockets of the
// face's skin, up to 0.8 beside them, and 0 away from the nose.
std::vector<float> enclosed_by_nose(const Mesh& mesh);

}  // namespace face::decode
