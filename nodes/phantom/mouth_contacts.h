// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/rig.h"

namespace face::phantom {

// The lips and teeth of one rig, for the performer: how to close them exactly.
class MouthContacts {
 public:
  // rig: null = a rig on which mouthClose undoes jawOpen one to one.
  explicit MouthContacts(const Rig* rig);

  // Sets mouthClose such that lips which are shut by `shut` (0 to 1) are that far closed: at 1 the mean gap over the
  // rig's lip pairs is 0. Where lips that are free would run into each other, the jaw opens until they touch.
  void close_lips(double shut, std::vector<float>& weights) const;

  // Roll, jaw and upper lip at which the lower lip touches the upper teeth, and the distance that is left.
  struct LipTeethPose {
    double roll = 0.7, jaw = 0.06, upper = 0.22;
    double distance_mm = 0;
  };
  const LipTeethPose& lip_teeth() const { return lip_teeth_; }

 private:
  double gap_mm(const std::vector<float>& weights, std::size_t without) const;

  std::vector<double> gap_per_weight_;  // mean over the pairs, mm; one per ARKit shape
  LipTeethPose lip_teeth_;
};

}  // namespace face::phantom
