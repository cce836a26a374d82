// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/base/normal_harmonics.h"
#include "nodes/base/random.h"
#include "nodes/model/face_pose.h"
#include "nodes/model/picture_level.h"
#include "nodes/model/skin_basis.h"
#include "nodes/model/skin_points.h"
#include "nodes/types/face_fit.h"

namespace face::model {

// What no light of one direction explains, highlights above all, changes slowly with the direction of the normal: the
// harmonics of the normal in the camera's frame, added to all channels.
inline constexpr std::size_t shading_parameters = normal_harmonics_count;

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
