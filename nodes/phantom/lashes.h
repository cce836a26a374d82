// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/attached.h"
#include "nodes/phantom/skin_layout.h"

namespace face::phantom {

// Adds the lashes of both upper lids as the part "lashes": three vertices per column of the lid, of which the second is
// the tip; first those of the left eye.
inline constexpr std::uint32_t kLashVertices = 3;
Attached add_lashes(HeadBuilder& head, const Skin& skin);

}  // namespace face::phantom
