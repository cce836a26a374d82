// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/mesh.h"
#include "nodes/types/rig.h"

namespace face::transfer {

struct LineMouthOptions {
  double brightness = 0.08;
};

// Spans the opening between a speaking model's lips with a dark surface, the part "mouth": what is behind the lips was
// taken out of the scans, and through the opening the background would be seen. Its corners are the edges of the lips,
// so that it moves with them; no vertex is added. mesh: the reference's, whose mouth is open; the rig has its vertices.
// brightness: of the lips' colours there, 0 is black. Without an opening the rig stays as it is.
Rig line_mouth(const Rig& rig, const Mesh& mesh, const LineMouthOptions& options = {});

}  // namespace face::transfer
