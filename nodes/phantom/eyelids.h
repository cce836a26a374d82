// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/vector3.h"

namespace face::phantom {

// The left eyeball.
inline constexpr Vector3 kEyeCentre = {31, 30, 78.4};
inline constexpr double kEyeRadius = 16.4;

// 1 at the outer corner, -1 at the inner one.
double lid_position(int column);
// 1 upper lid, -1 lower lid, 0 at the corners.
int lid_side(int column);
// Vertex of the left eye's lids in mm, for rings up to kLidOuterRing; `closed` is 0 for the resting eye, 1 when shut.
inline constexpr int kLidOuterRing = 3;
Vector3 lid_point(int ring, int column);

}  // namespace face::phantom
