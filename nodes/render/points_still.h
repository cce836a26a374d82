// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/mesh_points.h"

namespace face::render {

// Vertices without polygons as dots, from the front and from their left; the nearer, the brighter. The frame holds all
// finite ones.
Image points_still(const MeshPoints& points);

// Named points of a picture without the picture: green where valid, red rings where lost, in a frame that holds all,
// at the size that they have in their picture or smaller.
Image landmarks_still(const Landmarks& landmarks);

}  // namespace face::render
