// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/eyes.h"
#include "nodes/phantom/head_builder.h"

namespace face::phantom {

// Short hair, combed from a whorl at the back to the front and the head's left, as the part "hair". It is not symmetric.
void add_hair(HeadBuilder& head);
// Eyebrows as the part "brows", hanging on the nearest vertex of the skin.
Attached add_brows(HeadBuilder& head, const Skin& skin);
// Both ears as the part ears.
void add_ears(HeadBuilder& head);

}  // namespace face::phantom
