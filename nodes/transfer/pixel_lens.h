// SPDX-License-Identifier: Apache-2.0
// What a pixel sees: its own square, and what a sharp lens spreads into it.
#pragma once
#include <array>

namespace face::transfer {

constexpr int parts_per_px = 4;    // of a pixel's width, where layers are told apart
constexpr int lens_window = 16;    // parts that a pixel sees, with the lens's blur
constexpr double lens_px = 0.5;    // standard deviation of a sharp lens's blur
constexpr double no_share = 0.03;  // shares of a pixel that are none

// How a pixel weighs the parts about it in a row or a column: its own width, through the lens. They sum to 1.
const std::array<double, lens_window>& lens_weights();

// The first of the parts that a pixel sees, along a row or a column.
constexpr int first_part(int pixel) { return parts_per_px * pixel - (lens_window - parts_per_px) / 2; }

}  // namespace face::transfer
