// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/landmarks.h"

namespace face::decode {

// Of MediaPipe's face mesh (468 points, or 478 with the irises; names "0", "1", ...) those that are Multi-PIE's 68,
// named "00" to "67". The outline's are where the mesh ends.
Landmarks multi_pie_of_media_pipe(const Landmarks& mesh);

// The same points, "0" to "9" called "00" to "09".
Landmarks with_two_digits(Landmarks points);

// Of Multi-PIE's 68 (in their order) the 18 that a clip is tracked by.
Landmarks clip_points_of_multi_pie(const Landmarks& points);

}  // namespace face::decode
