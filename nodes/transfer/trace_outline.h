// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/transfer/outline.h"
#include "nodes/types/image.h"

namespace face::transfer {

// The outline of an eye near a border that is known to some pixels: moved to where the picture has an edge, over its
// normals, by dynamic programming along the closed curve; what is bright inside, as the white of an eye, before what is
// dark, with as many harmonics as an eye's outline needs; then to every edge that is near. Lashes are as dark as an
// iris, and there the curve goes on as it did beside it. Corners are a pixel apart.
Outline trace_outline(const Image& picture, const std::vector<Place>& border);

}  // namespace face::transfer
