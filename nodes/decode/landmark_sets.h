// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/landmarks.h"

namespace face::decode {

// Of MediaPipe's face mesh (468 points, or 478 with the irises; names "0", "1", ...) those that are Multi-PIE's 68,
// named "0" to "67". The outline's are where the mesh ends.
Landmarks multi_pie_of_media_pipe(const Landmarks& mesh);

// Of Multi-PIE's 68 (names "0" to "67", in order) the 18 that a clip is tracked by.
Landmarks clip_points_of_multi_pie(const Landmarks& points);

}  // namespace face::decode
