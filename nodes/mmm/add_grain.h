// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "nodes/types/image.h"
#include "nodes/types/mmm.h"
#include "nodes/types/weights.h"

namespace face::mmm {

struct AddGrainOptions {
  double amount = 1;
  std::int64_t seed = 1;
};

// Standard deviation of the camera's noise in a picture, grey levels, per channel: the second difference of second
// differences leaves little of what is smooth (Immerkaer, Fast Noise Variance Estimation, CVIU 1996, Eq. 2). Differs
// from the paper: the median of its size in place of the mean, so that edges do not count.
double grain_level(const Image& image, int channel);

// A synthesised mouth with the grain of the pictures that it is made of. A mean of pictures has less noise than each of
// them, by the sum of the squares of its shares: pasted into a real one it looks like wax. What is missing is drawn
// anew: amount^2 sigma^2 (1 - sum beta^2), sigma that of the reference prototype (grain_level).
// image: of mmm.synthesise at these parameters. id: the frame's, for its own noise; null = that of an empty id.
Image add_grain(const Mmm& model, const Weights& parameters, const Image& image, const std::string* id,
                const AddGrainOptions& options = {});

}  // namespace face::mmm
