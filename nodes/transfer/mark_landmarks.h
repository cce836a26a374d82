// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/rig.h"

namespace face::transfer {

// The rig with the 68 landmarks of Multi-PIE, which points of a video move it by; one that has them stays as it is.
// They are carried over from another head, the reference, by places that shapes and geometry tell on both: where the
// lids are (eyeBlinkLeft, eyeBlinkRight), the tip of the nose, the most forward place of the chin, and the pairs of
// inner lips. The reference is scaled and moved to where these places agree best, what is left of them is shared out by
// distance (Shepard, A two-dimensional interpolation function for irregularly-spaced data, 1968), and the mouth's
// landmarks go as far sideways as the inner lips lie apart. Each becomes the nearest vertex of the skin that looks the
// same way, on the lip that it belongs to. A few millimetres off, as lips' colours and wrinkles do not count.
// Rig and reference: mm, y up, looking to +z. Throws, naming what is missing, where the rig's lids, jawOpen or inner
// lips (at least three pairs) do not tell enough, and where the reference has no landmarks.
Rig mark_landmarks(const Rig& rig, const Rig& reference);

}  // namespace face::transfer
