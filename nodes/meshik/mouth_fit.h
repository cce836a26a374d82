// SPDX-License-Identifier: Apache-2.0
// A rig's jaw and mouth shapes, as landmarks see them from the front, and the likeliest weights of them. Internal to
// the area; Eigen stays out.
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

#include "nodes/meshik/landmark_vertices.h"
#include "nodes/types/rig.h"
#include "nodes/types/visemes.h"

namespace face::meshik {

// How likely weights are before a landmark has been seen.
struct MouthPrior {
  double restraint = 0.02;
  double variety = 2;
  double common_share = 0.1;
  double own_deviation = 0.02;
  double landmark_error_mm = 0.4;
  double gap_error_mm = 0.2;
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
  // is left of `wanted` stays in it. seen: landmarks that count, empty = all. How far inner lips are apart (points 61
  // to 63 of Multi-PIE above 67 to 65) counts beside their places: what is wrong with the head's pose is wrong with
  // both; but not for a viseme whose lower lip touches the teeth and has rolled in (F, V). With visemes the result is
  // the mean over them, each as likely as it explains the landmarks (a mixture of Gaussians; Bishop, Pattern
  // Recognition and Machine Learning, 2006, section 2.3.9; the range of the weights is left out of how likely a viseme
  // is, and those below a thousandth out of the mean).
  std::vector<double> weights(std::vector<double>& wanted, const std::vector<double>& least = {},
                              const std::vector<bool>& seen = {}) const;

 private:
  std::vector<std::vector<double>> rows_;  // per shape of the rig
  std::vector<std::size_t> used_;
  std::vector<std::pair<std::size_t, std::size_t>> gaps_;  // places of inner lips, upper and lower
  double gap_weight_ = 0;                                  // of a gap's square, where a coordinate's counts as 1
  double error_mm_ = 0;
  double rolled_weight_ = 0;  // of the y of a lower inner lip that has rolled in
  std::size_t roll_ = 0;      // place of mouthRollLower in used_, or how many these are
  // Of each viseme; without visemes one.
  struct Expected {
    std::vector<double> inverse;  // used x used: covariance of the weights in squares of the landmarks' error, inverse
    bool rolls_lip = false;       // below the teeth
  };
  std::vector<Expected> expected_;
};

}  // namespace face::meshik
