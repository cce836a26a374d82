// SPDX-License-Identifier: Apache-2.0
// A rig's jaw and mouth shapes, as landmarks see them from the front, and the likeliest weights of them. Internal to
// the area; Eigen stays out.
#pragma once
#include <cstddef>
#include <vector>

#include "nodes/meshik/landmark_vertices.h"
#include "nodes/types/rig.h"
#include "nodes/types/visemes.h"

namespace face::meshik {

// How likely weights are before a landmark has been seen.
struct MouthPrior {
  double restraint = 0.02;
  double variety = 2;
  double own_deviation = 0.02;
  double landmark_error_mm = 0.4;
};

class MouthFit {
 public:
  // places: the landmarks' vertices, all of them on the rig. visemes: which weights go together; null = every weight is
  // as likely as another. Throws where no jaw or mouth shape moves a landmark.
  MouthFit(const Rig& rig, const std::vector<LandmarkVertex>& places, const Visemes* visemes, const MouthPrior& prior);

  // Offsets of the landmarks' x and y (mm, as the rig has them) by the shape; empty where it does not count.
  const std::vector<double>& row(std::size_t shape) const { return rows_[shape]; }

  // The weights of the rig's shapes, each from its `least` (empty = 0) to 1, whose landmarks are nearest to `wanted`
  // (least squares with the prior, coordinate by coordinate; Hildreth, A Quadratic Programming Procedure, 1957). What
  // is left of `wanted` stays in it. seen: landmarks that count, empty = all.
  std::vector<double> weights(std::vector<double>& wanted, const std::vector<double>& least = {},
                              const std::vector<bool>& seen = {}) const;

 private:
  std::vector<std::vector<double>> rows_;  // per shape of the rig
  std::vector<std::size_t> used_;
  std::vector<double> expected_;  // used x used: inverse covariance in squares of the landmarks' error
};

}  // namespace face::meshik
