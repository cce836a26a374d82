// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/matrix.h"
#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"

namespace face::mmm {

struct CheckLabelsOptions {
  double tolerance_s = 0.1;
  double window_s = 3;         // of speech that is judged at a time
  double match_score = -4.5;   // of a window: clean speech has -3 to -1 with its own labels, with others -7 to -4.5
  double most_apart_s = 0.15;  // median of a window; labels by hand and by machine are within 0.03
};

// The phones, if they are those of the video: segments that follow each other without gap, from 0 to the video's end,
// within tolerance_s (a sound may end a few frames before or after the pictures). With apart_s (N x 1, and the phones
// with scores, both of speech.fit_phones) also what is said has to be what is heard, everywhere: no window of speech
// may fit badly. Else throws and names the first phone that does not fit.
Phones check_labels(const Phones& phones, const Timeline& timeline, const Matrix* apart_s,
                    const CheckLabelsOptions& options = {});

}  // namespace face::mmm
