// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/mesh.h"

namespace face::transfer {

struct RecolourOptions {
  double recorded = 0;
  double smooth_mm = 0;
};

// Gives a speaking face other colours (Bargmann, Blanz and Seidel, section 7: grey to colour, or a texture replaced).
// mesh: the speaking model's, grey; colours: the same vertices in the colours to take (transfer.resample). recorded: 0
// replaces the texture; 1 keeps the recorded light and dark and takes hue and saturation alone (luma of BT.601);
// between, a mixture. smooth_mm: the new colours are averaged that far along the mesh first, for grain and seams.
Mesh recolour(const Mesh& mesh, const Mesh& colours, const RecolourOptions& options = {});

}  // namespace face::transfer
