// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/rig.h"

namespace face::phantom {

// Makes the eyes of a person shut as those of the rig do: where a vertex of an upper lid meets one of the lower lid at
// eyeBlink's weight 1 on the rig, but has moved away from it in the person, the person's eyeBlink takes it there; the
// lid around follows by its share of the motion. Shut lids stay as far from the eyeball, in its radii, as the rig's do:
// where they would lie deeper, eyeBlink lifts them. A person that has not moved keeps its shapes, bit for bit.
void shut_lids(const Rig& rig, Rig& person);

}  // namespace face::phantom
