// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/mesh.h"
#include "nodes/types/rig.h"

namespace face::transfer {

struct LineMouthOptions {
  double brightness = 0.08;
  double rim_mm = 1.5;
};

// Spans the opening between a speaking model's lips with a dark surface, the part "mouth": what is behind the lips was
// taken out of the scans, and through the opening the background would be seen. Its corners are the edges of the lips,
// so that it moves with them. mesh: the reference's, whose mouth is open; the rig has its vertices, and its neutral is
// the mouth that is shut. brightness: of the lips' colours there, 0 is black. Without an opening the rig stays as it
// is.
// The lips of the mesh end where the reference shows them end; lips that roll inwards go on, and where they are shut a
// line would be left open. With rim_mm both grow by a rim, the part "rims", to the middle of what the neutral leaves
// open, by no more than that: a vertex for each of the edges', behind those of the rig, in its colour and with its
// motion. Without, no vertex is added.
Rig line_mouth(const Rig& rig, const Mesh& mesh, const LineMouthOptions& options = {});

}  // namespace face::transfer
