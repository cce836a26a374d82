// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/eyes.h"
#include "nodes/phantom/head_builder.h"

namespace face::phantom {

// A short head of hair, standing off the skull, as the part "hair".
void add_hair(HeadBuilder& head);
// Eyebrows as the part "brows", hanging on the nearest vertex of the skin.
Attached add_brows(HeadBuilder& head, const Skin& skin);
// Both ears as the parts ear_left and ear_right.
void add_ears(HeadBuilder& head);

}  // namespace face::phantom
