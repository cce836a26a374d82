// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/attached.h"
#include "nodes/phantom/skin_layout.h"

namespace face::phantom {

// Adds both eyebrows as the part "brows".
Attached add_brows(HeadBuilder& head, const Skin& skin);

}  // namespace face::phantom
