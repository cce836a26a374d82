// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::track {

// How much contrast a picture has in the colours of FaceColours (red and blue to green, brightness): the local contrast
// of its face from the eyes to below the nose, as multiples of what an ungraded film gives. Deviation of each from its
// mean over 0.7 distances of the inner corners of the eyes, so that light from the side does not count, of brightness
// as a share of the mean. The mouth is left out: its hollow would tell how far it is open. Within 0.15 (below, a film's
// coding and grain are no less than what is seen) and 3. All 1 where the corners of the eyes and the tip of the nose
// are not there or not in the picture.
std::array<double, 3> face_contrast(const Image& image, const Landmarks& landmarks);

}  // namespace face::track
