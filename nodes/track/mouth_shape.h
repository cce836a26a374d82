// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "nodes/types/landmarks.h"

namespace face::track {

// Which of the start points lie on the outer edge of the lips, in order around it: a corner of the mouth first, the
// other corner opposite (element count / 2). Empty where start has none of the names. Throws where it has some only.
std::vector<std::size_t> find_outline(const Landmarks& start, const std::vector<std::string>& names);

// The ways in which the edge of a mouth changes its shape: 2N entries (x, y of each point) a mode, in pixels, of a size
// that is usual in speech (one standard deviation). The mouth as a whole moves and widens; each lip rises as a parabola
// over the width, each corner by itself: the freedoms of the mouth template of Yuille, Hallinan and Cohen (Feature
// Extraction from Faces Using Deformable Templates, IJCV 1992), applied to the start points as offsets. The points of
// the jaw line (may be none) fall with the lower lip, and move, widen and tilt together.
std::vector<std::vector<double>> mouth_modes(const Landmarks& start, const std::vector<std::size_t>& outline,
                                             const std::vector<std::size_t>& jaw_line);

// That of these modes in which the jaw falls.
inline constexpr std::size_t lower_lip_mode = 4;

// The distance of the corners of the mouth.
double mouth_width_px(const Landmarks& start, const std::vector<std::size_t>& outline);

}  // namespace face::track
