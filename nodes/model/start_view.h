// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "nodes/model/lip_rims.h"
#include "nodes/model/pixel_rows.h"

namespace face::model {

// The picture that a fit was made on, at one size, and how the skin lies in it. A map of colours that is read at
// vertices is coarser than the dark line between lips; this is as fine as the picture.
struct StartView {
  PictureState state;
  std::vector<Vec3f> points_mm, normals;  // local vertices
  PictureLevel level;
  DrawnSkin drawn;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // that are drawn
};

StartView start_view(const SkinBasis& basis, const std::vector<double>& identity, const PictureState& state,
                     PictureLevel level);

// Gives points the reflectance that the picture shows there, the light undone; those that it does not show, or from the
// side, or in the dark, keep their colours, which hold what they mirror. basis: of the points; it may have fewer
// triangles than the view's. rims: where lips have parted since, their rims have the colour that the lip has farther
// out; empty lists leave all as it is.
void colour_points(const StartView& view, const SkinBasis& basis, const LipRims& rims, std::vector<SkinPoint>& points);

}  // namespace face::model
