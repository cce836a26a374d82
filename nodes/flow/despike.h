// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/flow/plane.h"

namespace face::flow {

// Replaces pixels that are unlike all but at most three of their eight neighbours by the median of those: single wild
// pixels, not small dots. A pixel is wild where the sum of its four smallest absolute differences to its neighbours
// exceeds a threshold (the rank-ordered statistic of Garnett, Huegerich, Chui and He, A Universal Noise Removal
// Algorithm with an Impulse Detector, IEEE Trans. Image Processing 2005, eq. 4). threshold: in the channel's units; the
// sum's median over the picture times 4 where that is more, so that fine noise is left alone.
void despike(Plane& plane, float threshold);

}  // namespace face::flow
