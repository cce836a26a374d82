// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/phantom/sculptor.h"

namespace face::phantom {

// Colours the skin's vertices: a warm base, red cheeks, nose and lips, shaded lids, dark nostrils and mouth.
void paint_skin(HeadBuilder& mesh, const Skin& skin);

}  // namespace face::phantom
