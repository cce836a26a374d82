// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/rig.h"
#include "nodes/types/vec.h"

namespace face::render {

// The share of the light in front of the face that reaches each vertex, V: 1 outside the mouth; inside it (parts named
// after mouth, gums, tongue or teeth) the form factor A / (A + pi d^2) of the opening between the lips, of area A, at
// distance d (Siegel and Howell, Thermal Radiation Heat Transfer, 1981, disk seen from its axis). So teeth just behind
// parted lips are bright, the throat is dark, and a closed mouth is black inside.
// Lips have depth, so A is taken as less the lower the opening is. It is the polygon of landmarks 60-67, else spanned by the pairs of Rig::inner_lips; with neither it counts as
// 35 x 20 mm in front of the part.
std::vector<float> mouth_exposure(const Rig& rig, const std::vector<Vec3f>& points_mm);

}  // namespace face::render
