// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/phantom/face_places.h"
#include "nodes/types/rig.h"
#include "nodes/types/surface_dots.h"

namespace face::phantom {

// Moles and, on light skin, freckles, at random places of the face beside lips, eyes and brows.
SurfaceDots random_moles(const Rig& rig, const FacePlaces& places, std::int64_t seed, double lightest = 1);

// 55 markers as a motion capture stage glues them on, at places told by the 68 landmarks; the same for every person of
// a rig. Names end in _right or _left (of the head), or stand alone in the middle.
SurfaceDots named_markers(const Rig& rig, const FacePlaces& places, double radius_mm, Vector3 color_srgb);

}  // namespace face::phantom
