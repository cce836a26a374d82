// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "nodes/track/outline.h"
#include "nodes/track/patch.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/matrix.h"

namespace face::track {

// Which of the start points lie on the contour of the chin, in order from one side to the other. Empty where start
// lacks one of the names.
std::vector<std::size_t> find_jaw_line(const Landmarks& start, const std::vector<std::string>& names);

// What the contour of the chin looks like where somebody placed it: a row per point, grey values along the normal of
// the line through the ends, away from the mouth. Skin is even, but chin and throat are lit differently. mouth_px: the
// mouth's width, which tells the size of everything. outline: of the lips; the jaw line lies below it.
Matrix learn_jaw_line(const Grey& grey, const Landmarks& points, const std::vector<std::size_t>& line,
                      const std::vector<std::size_t>& outline, double mouth_px);

// Where that is seen again, one entry per point of the line: across it, as surely as its contrast and likeness let it
// be; along it nothing is known. expected: where the points should be.
EdgeSight see_jaw_line(const Grey& grey, const Landmarks& expected, const std::vector<std::size_t>& line,
                       const std::vector<std::size_t>& outline, double mouth_px, const Matrix& look);

}  // namespace face::track
