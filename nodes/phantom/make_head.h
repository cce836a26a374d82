// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/rig.h"

namespace face::phantom {

struct MakeHeadOptions {
  bool with_hair = true;
};

// Makes the embedded head: a stylised human head with lips, mouth, teeth, tongue and eyes, and all 52 ARKit shapes, so
// that a machine without any data has a rig. Always the same, bit for bit; its left is the exact mirror image of its
// right.
//
// Frame: mm, y up, z to the viewer, x to the head's left; the mouth lies at y = -34, the eyes at y = 30, the crown at
// y = 144 and the chin at y = -76. At rest the mouth is shut with the lips touching, and the eyes are open.
// Shapes follow ARKit's documentation (ARFaceAnchor.BlendShapeLocation). As in ICT-FaceKit, mouthClose only corrects
// jawOpen: with both at the same weight the lips meet while the jaw is lowered. tongueOut is meant for an open jaw.
Rig make_head(const MakeHeadOptions& options = {});

}  // namespace face::phantom
