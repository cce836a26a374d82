// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <vector>

#include "nodes/model/skin_basis.h"
#include "nodes/types/morphable_model.h"

namespace face::model {

// The rims of lips that meet, whose darkness is each other's shadow and no colour of theirs.
struct LipRims {
  // Of a local vertex: how far to go along the head's y, away from where the lips meet, to see the lip's own colour; 0
  // beyond the rims.
  std::vector<float> outwards_mm;
  // Of a local vertex: 0 = as near to the other lip as in the first picture, 1 = far from it.
  std::vector<float> parted;
};

// Knows the rims of a model's lips, and how far apart they are in the first picture.
class PartingLips {
 public:
  // first_expression: of the first picture.
  PartingLips(const MorphableModel& model, const SkinBasis& basis, const std::vector<double>& first_expression);

  // Empty where the model names no landmarks or no inner lips.
  LipRims at(const std::vector<double>& expression) const;

 private:
  // A pair of inner lips, from the right corner to the left one.
  struct Place {
    double x_mm = 0;
    std::vector<double> row;  // what expression adds to the pair's gap
    double first_mm = 0;      // the gap in the first picture
  };

  std::vector<Place> places_;  // by x
  std::array<double, 2> corners_x_mm_{};
  std::vector<float> outwards_mm_;
  std::vector<double> x_mm_;  // local vertices
};

}  // namespace face::model
