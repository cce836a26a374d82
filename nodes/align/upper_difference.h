// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::align {

// How unlike two frames of a face look above the mouth, where lids fall and eyes turn: root mean square of the
// differences in grey levels over the box about the upper markers, the second picture brought onto the first by the
// affine motion of those that both see. The mouth, which is meant to differ, and the head's motion do not count. 0
// where fewer than three markers, or markers on a line, are seen by both. pictures: of equal size, grey or colour.
double upper_difference(const Image& a, const Landmarks& a_markers, const Image& b, const Landmarks& b_markers);

}  // namespace face::align
