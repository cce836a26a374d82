// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/rig.h"

namespace face::decode {

// Fills what a file does not say about the mouth, from the geometry and from jawOpen: inner_lips (three pairs about the
// middle of the mouth), lower_lip and upper_teeth. What is filled already is kept and used for the rest. Leaves a list
// empty where the mesh has no such thing (no teeth, lips that jawOpen does not part).
void find_mouth_marks(Rig& rig);

}  // namespace face::decode
