// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "nodes/base/random.h"
#include "nodes/model/face_pose.h"
#include "nodes/model/skin_basis.h"
#include "nodes/render/rasterize.h"
#include "nodes/types/face_fit.h"
#include "nodes/types/image.h"

namespace face::model {

// A picture at one size with its gradient, as numbers in [0, 1] over its exposure.
struct PictureLevel {
  int width = 0, height = 0;
  double factor = 1;                          // of its size over the picture's
  std::vector<std::array<float, 9>> samples;  // per pixel: R G B, then d/dx of them, then d/dy
};

// factor <= 1. Blurred a little, so that gradients reach as far as a pixel or two. exposure: what numbers are
// divided by.
PictureLevel make_level(const Image& picture, double factor, double exposure = 1);

// A level's samples between its pixels; what lies outside is as at the edge.
std::array<float, 9> sample_at(const PictureLevel& level, double x_px, double y_px);

// What no light of one direction explains, highlights above all, changes slowly with the direction of the normal:
// the spherical harmonics up to the second order of the normal in the camera's frame, added to all channels (as Basri
// and Jacobs, Lambertian Reflectance and Linear Subspaces, PAMI 2003, use them for light from everywhere).
inline constexpr std::size_t shading_parameters = 9;
std::array<double, shading_parameters> shading_at(const std::array<double, 3>& normal_in_camera);

// Of what one picture depends on beside identity and albedo.
struct PictureState {
  FacePose pose;  // in the picture's own pixels
  std::vector<double> expression;
  FaceLight light;
  std::vector<float> seen;  // local vertices: the share of the parallel light that reaches them; empty = all of it
  std::array<double, shading_parameters> shading{};  // what is brighter than that, by harmonics of the normal
};

// The face's own shadow at a state.
std::vector<float> shadow_of(const SkinBasis& basis, const std::vector<double>& identity, const PictureState& state);

// Light parameters, in order: ambient 3, parallel 3, turn of the direction 2, contrast 1, gain 3, offset 3, mirror 2.
inline constexpr std::size_t light_parameters = 17, first_mirror = 15;
FaceLight moved(const FaceLight& light, const double* step);

// Which columns are wanted. Those of identity, albedo, pose (7), expression, light and shading follow each other in
// this order.
struct PixelColumns {
  std::size_t identities = 0, albedos = 0, expressions = 0;
  bool light = true;
  bool shading = false;
  std::size_t pose_first() const { return identities + albedos; }
  std::size_t expression_first() const { return pose_first() + FacePose::size; }
  std::size_t light_first() const { return expression_first() + expressions; }
  std::size_t shading_first() const { return light_first() + (light ? light_parameters : 0); }
  std::size_t size() const { return shading_first() + (shading ? shading_parameters : 0); }
};

// Differences picture minus model at random points of the visible skin, and their derivatives: 3 rows per point.
struct PixelRows {
  std::size_t columns = 0;
  std::vector<float> jacobian;  // 3P x columns: derivatives of the residual
  std::vector<float> residual;  // 3P
  std::size_t visible = 0;      // pixels of skin that are seen
  double overexposed = 0;       // share of the points at the end of the scale
  double dark = 0;              // share of the points that are all but black
  double brightness = 0;        // mean of the points' largest channel, 0 to 1
};

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

// Residuals and derivatives at these points; those seen at a grazing angle are left out. The normal turns with the
// triangle: for displacements d1, d2 of its edges' far ends, dn = -(d1 . n) e^1 - (d2 . n) e^2 with the dual basis e^1,
// e^2 in its plane. albedo: of each local vertex.
PixelRows rows_at(const std::vector<SkinPoint>& points, const SkinBasis& basis, const std::vector<Vec3f>& posed_mm,
                  const std::vector<Vec3f>& albedo, const PictureState& state, const PictureLevel& level,
                  const PixelColumns& columns);

// Both, for a model at these coefficients.
PixelRows pixel_rows(const SkinBasis& basis, const std::vector<double>& identity, const std::vector<Vec3f>& albedo,
                     const PictureState& state, const PictureLevel& level, const PixelColumns& columns,
                     std::size_t points, Random& random);

}  // namespace face::model
