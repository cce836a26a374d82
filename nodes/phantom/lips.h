// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/vector3.h"

namespace face::phantom {

// How far column c of the mouth's loops lies from the middle: 1 at the left corner, -1 at the right one.
double lip_position(int column);
// 1 upper lip, -1 lower lip, 0 at the corners.
int lip_side(int column);
// Vertex of ring 0 (border of the red) and deeper, in mm. The lips touch along ring -4.
Vector3 lip_point(int ring, int column);

}  // namespace face::phantom
