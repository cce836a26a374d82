// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"

namespace face::render {

struct PlaceBesideOptions {
  int height_px = 576;  // of both; widths follow
};

// Two pictures side by side, both brought to one height, so that a film can be compared with what was made from it.
// The width is even, as video wants it: a black column is added where it would not be. height_px: even.
Image place_beside(const Image& left, const Image& right, const PlaceBesideOptions& options = {});

}  // namespace face::render
