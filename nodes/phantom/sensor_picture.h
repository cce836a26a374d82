// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/phantom/scanner_view.h"

namespace face::phantom {

// Which pixels of a grey picture (height x width, rows from the top) differ from one of their eight neighbours by more
// than `least`: 1, else 0.
std::vector<std::uint8_t> edges_of(const std::vector<float>& grey, PictureSize size, float least);

// The blur of a lens: a Gaussian of this standard deviation over light (height x width, linear), whose sum over the
// pixels within the picture is 1.
void blur_light(std::vector<float>& light, PictureSize size, double deviation_px);

}  // namespace face::phantom
