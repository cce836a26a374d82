// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "nodes/base/random.h"
#include "nodes/model/face_pose.h"
#include "nodes/model/picture_level.h"
#include "nodes/model/skin_basis.h"
#include "nodes/render/rasterize.h"

namespace face::model {

// A point of the skin: it stays on its triangle while parameters change (Blanz and Vetter, Face Recognition Based on
// Fitting a 3D Morphable Model, PAMI 2003, section 4.2, take centres of triangles).
struct SkinPoint {
  std::uint32_t triangle = 0;   // of the basis
  Vec3f weights = {1, 0, 0};    // of its corners
  std::optional<Vec3f> albedo;  // its own where it is known, else its corners'
  bool mirrors = true;          // false: that colour holds what it mirrors
};

// A level as it would be filled by the skin.
struct DrawnSkin {
  std::vector<render::ScreenPoint> screen;  // local vertices
  render::Raster raster;
};
DrawnSkin draw_skin(const SkinBasis& basis, const std::vector<Vec3f>& posed_mm, const FacePose& pose,
                    const PictureLevel& level);

// Random points of the skin that is seen, at middles of pixels, without repetition. visible: number of such pixels.
std::vector<SkinPoint> choose_points(const SkinBasis& basis, const std::vector<Vec3f>& posed_mm, const FacePose& pose,
                                     const PictureLevel& level, std::size_t points, Random& random,
                                     std::size_t& visible);
std::vector<SkinPoint> choose_points(const SkinBasis& basis, const DrawnSkin& drawn, std::size_t points, Random& random,
                                     std::size_t& visible);

}  // namespace face::model
