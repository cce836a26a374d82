// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/head_builder.h"

namespace face::phantom {

// Adds short hair as the part "hair": 27 locks, combed from a whorl at the back to the front and to the head's left. It
// is the one part that is not symmetric.
void add_hair(HeadBuilder& head);

}  // namespace face::phantom
