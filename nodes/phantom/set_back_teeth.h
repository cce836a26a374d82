// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/rig.h"

namespace face::phantom {

// Moves teeth, gums and tongue of a person back, as one solid, where its lips have come nearer to the upper front teeth
// than they are on the rig: identity modes that were made from skin alone push teeth through thin lips. A loss of up to
// 0.5 mm stays. Returns by how many mm they went back.
double set_back_teeth(const Rig& rig, Rig& person);

}  // namespace face::phantom
