// SPDX-License-Identifier: Apache-2.0
// What a fit of one or several pictures of a person works on.
#pragma once
#include <cstddef>
#include <vector>

#include "nodes/model/fit_image.h"
#include "nodes/model/landmark_basis.h"
#include "nodes/model/pixel_rows.h"

namespace face::model {

// One picture, and what is its own.
struct Picture {
  LandmarkBasis landmarks;
  PictureState state;
  double log_focal = 7;
  double eyes_px = 100;
  double exposure = 1;  // what the picture is divided by: a dark one is fitted as if its skin were of usual brightness
  double doubt = 1;     // weight of points and priors over what they have where the model explains the picture
  bool closed = false;  // the mouth is held closed
  double held_gap_mm = 0;  // if more than 0: the mouth is held open by this on average
};

inline constexpr double huber_sigmas = 2.5;  // from which an error of a point counts linearly only

// All pictures, and what they share.
struct Joint {
  const MorphableModel* model = nullptr;
  FitImageOptions options;
  SkinBasis basis;
  std::vector<double> identity, albedo;
  std::vector<std::vector<double>> gaps;
  std::vector<Picture> pictures;
  bool mirror_held = false;  // what skin mirrors stays as it is

  PixelColumns columns() const { return {basis.identities, basis.albedos, basis.expressions, true}; }
  std::size_t shared() const { return basis.identities + basis.albedos; }
  std::size_t own() const { return FacePose::size + basis.expressions + light_parameters; }
};

inline std::vector<double> joined(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result = a;
  result.insert(result.end(), b.begin(), b.end());
  return result;
}

// How far the mouth of a picture is open: mean over the lip pairs, mm.
double gap_of(const Joint& joint, std::size_t index);

// What a coefficient of expression adds to that.
std::vector<double> mean_gap_row(const Joint& joint);

// Robust squared distance of a picture's points to where the model has them, in sigmas.
double point_cost(const Joint& joint, std::size_t index);

// Robust difference of a picture and the model (Geman and McClure's cost, mean over fixed random points).
double image_cost(const Joint& joint, std::size_t index, const PictureLevel& level);

// What the fit of a picture is worth, and what is wrong with it. small: the picture at the size that
// likeness takes.
void report(Joint& joint, std::size_t index, const PictureLevel& level, const PictureLevel& small, FaceFit& fit);

}  // namespace face::model
