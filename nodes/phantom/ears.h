// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/head_builder.h"

namespace face::phantom {

// Adds both ears as the part "ears". They stand on the skull and do not move.
void add_ears(HeadBuilder& head);

}  // namespace face::phantom
