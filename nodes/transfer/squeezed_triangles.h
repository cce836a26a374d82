// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/render/rasterize.h"
#include "nodes/types/image.h"
#include "nodes/types/mesh.h"

namespace face::transfer {

// Where a mesh's vertices are in the picture that its uvs are of.
std::vector<render::ScreenPoint> places_in_picture(const Mesh& mesh, const Image& picture);

// Triangles whose surface is hidden: most of those about them keep less than a share of the area that they had, or are
// turned over.
std::vector<bool> squeezed_triangles(const std::vector<render::Triangle>& triangles,
                                     const std::vector<render::ScreenPoint>& before,
                                     const std::vector<render::ScreenPoint>& now, double least_area);

}  // namespace face::transfer
