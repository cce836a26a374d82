// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/render/render_head.h"
#include "nodes/types/image.h"
#include "nodes/types/rig.h"

namespace face::render {

struct ShapeSheetOptions {
  int columns = 6;
  int picture_px = 220;  // width and height of one head
  double yaw_deg = 15;   // slightly from the side: what comes forward is seen
  Framing framing = Framing::face;
};

// A contact sheet of the neutral head and of every ARKit shape at weight 1, with its name underneath; mouthClose, which
// closes an open jaw, together with jawOpen. A second head stands to the right of the first in every picture. Where a
// shape is among a rig's missing ones, that is written under its name.
Image shape_sheet(const Rig& rig, const Rig* beside, const ShapeSheetOptions& options = {});

}  // namespace face::render
