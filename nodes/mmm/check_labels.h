// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"

namespace face::mmm {

struct CheckLabelsOptions {
  double tolerance_s = 0.1;
};

// The phones, if they are those of the video: segments that follow each other without gap, from 0 to the video's end,
// within tolerance_s (a sound may end a few frames before or after the pictures). Else throws and names the first phone
// that does not fit. What is said in a video of the same length cannot be told apart so.
Phones check_labels(const Phones& phones, const Timeline& timeline, const CheckLabelsOptions& options = {});

}  // namespace face::mmm
